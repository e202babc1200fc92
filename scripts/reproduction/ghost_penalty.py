"""Fig. 9: the stress near slivers of cut cells."""

import math

from .family import Verdict
from .runs import Run
from .section import Album, Runs, claims, joined, told, verdicts


def _verdict(holds: bool) -> Verdict:
    return Verdict.confirmed if holds else Verdict.contradicted


def _deviation(run: Run, reference: Run) -> float:
    """Largest relative difference of the stress in the material, where it is not small."""
    pairs = list(zip(run.stress_near_holes, reference.stress_near_holes))
    large = 0.1 * max(stress for _, stress in pairs)
    return max(abs(a / b - 1) for a, b in pairs if b > large)


def ghost_penalty(families: Runs, album: Album) -> str:
    r = {name: family.run for name, family in families.items()}
    names = ["ghost_none_p1", "ghost_paper_p1", "ghost_none_p2", "ghost_paper_p2", "ghost_full_p2"]
    stresses = {n: r[n].largest_inner_stress() for n in names if not r[n].failure}
    reference = r["ghost_reference"].largest_inner_stress()
    texts = {n: f"{stresses[n] / 1e6:.3g} MPa" if n in stresses else f"`{r[n].failure}`" for n in names}
    is_cured = {
        n: n in stresses and abs(stresses[n] / reference - 1) < 0.2 for n in ("ghost_paper_p1", "ghost_paper_p2")
    }
    deviation = [
        _deviation(r["ghost_none_p1"], r["ghost_paper_p1"]),
        _deviation(r["ghost_none_p2"], r["ghost_full_p2"]),
    ]
    return joined(
        "The table gives the largest von Mises stress over the 8 positions, from nodal values, more than 25 mm inside "
        f"the tread. The same wheel on a grid three times as fine has {reference / 1e6:.3g} MPa. Holes with a radius "
        "of 37.7 mm leave a sliver in a cut cell. Most radii do not, and then the stress is correct without a "
        "penalty.\n",
        claims(
            (
                "without ghost penalty the stress is badly wrong on small cuts",
                f"xi = 0: {texts['ghost_none_p1']} with degree 1, {texts['ghost_none_p2']} with degree 2 from nodal "
                f"values; in the material itself it differs from that with a penalty by at most "
                f"{100 * deviation[0]:.1f} % and {100 * deviation[1]:.1f} %",
                verdicts(
                    (
                        "from nodal values",
                        _verdict(
                            all(stresses.get(n, math.inf) > 2 * reference for n in ("ghost_none_p1", "ghost_none_p2"))
                        ),
                    ),
                    ("in the material", _verdict(max(deviation) > 0.2)),
                ),
            ),
            ("xi = 1e-3 in (81) cures it, degree 1", texts["ghost_paper_p1"], told(_verdict(is_cured["ghost_paper_p1"]))),
            ("xi = 1e-3 in (81) cures it, degree 2", texts["ghost_paper_p2"], told(_verdict(is_cured["ghost_paper_p2"]))),
            ("(not in the paper) the full penalty, xi = 1e-4, degree 2", texts["ghost_full_p2"], "the default here"),
        ),
        "The badly wrong stress lies outside the material. In a cell with a sliver, the displacement is determined "
        "only in the material; over the rest of the cell it is an extrapolation. Its steep gradients enter the nodal "
        "values from which such pictures are drawn, here and probably in the paper. The stress in the material was "
        "also computed from the displacement of every drawn piece of a cut cell (pieces thinner than a quarter of a "
        "cell may be missing); it hardly needs the penalty. The other purpose of the penalty, to keep the stiffness "
        "well conditioned, is not examined here.\n",
        "(81) penalizes only the jump of the stress. For degree 2 it leaves quadratic modes of slivers with almost no "
        "stiffness, down to rounding errors; the full penalty adds the jump of the second normal derivative.\n",
        *(
            album.copied(r[name], "stress_contact.svg", text)
            for name, text in (
                ("ghost_none_p1", "Degree 1, no ghost penalty"),
                ("ghost_paper_p1", "Degree 1, ghost penalty (81) with xi = 0.001"),
                ("ghost_none_p2", "Degree 2, no ghost penalty"),
                ("ghost_full_p2", "Degree 2, full ghost penalty with xi = 0.0001"),
            )
            if name in stresses
        ),
        "The colour scale ignores 1 % of the drawn pieces at each end, so that slivers do not darken the rest.\n",
    )
