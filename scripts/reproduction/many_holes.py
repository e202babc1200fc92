"""Figs 22 and 23: 48 and 108 holes."""

import math

from .runs import Run
from .section import Album, Runs, both_ways, claims, joined, percent


def _holes(run: Run) -> str:
    """Length by width of every kind of hole, from the axle outwards."""
    return ", ".join(map(str, run.holes)) + " mm"


def _shape_gap(a: Run, b: Run) -> float:
    """Largest difference of their holes' lengths and widths [mm]; infinite if the holes are other ones."""
    if len(a.holes) != len(b.holes):
        return math.inf
    return max(max(abs(x.length - y.length), abs(x.width - y.width)) for x, y in zip(a.holes, b.holes))


def _stiffer(run: Run, rules: Run) -> tuple[str, str]:
    """What is measured of the fall of J_e, and the verdict."""
    return (
        f"J_e {percent(run.change('strain_energy'))} in {len(run.history) - 1} shapes, volume "
        f"{percent(run.change('volume fraction'), 4)}; by the paper's rules "
        f"{percent(rules.change('strain_energy'))}, volume {percent(rules.change('volume fraction'))}",
        both_ways(run.change("strain_energy") < -0.1, rules.change("strain_energy") < -0.1),
    )


def holes_48(r: Runs, album: Album) -> str:
    je, jp2 = r["holes48_je"], r["holes48_jp2"]
    rules_je, rules_jp2 = r["rules_holes48_je"], r["rules_holes48_jp2"]
    spread = {run.name: run.peak_spread("final") for run in (je, jp2, rules_je, rules_jp2)}
    p = lambda value: f"{100 * value:.1f} %"  # noqa: E731
    return joined(
        "The paper does not say how its 48 holes are arranged. Here they form two rings of 24, in 24 sectors: their "
        "centres are 70 mm apart radially and 71 mm along the middle circle. 12 k^2 holes in k rings of 12 k always "
        "have such square spacing; 48 and 108 are the numbers for k = 2 and 3. Three rings of 16 would have spacings "
        "of 47 mm and 106 mm. Holes with the same total area as the 16 holes have a diameter of 46.2 mm and would then "
        "leave 0.5 mm between them radially.\n",
        claims(
            ("J_e alone finds a stiffer design", *_stiffer(je, rules_je)),
            (
                "J_e + 50 J_p2 gives another design (holes that differ by at least 2 mm)",
                f"holes of {_holes(je)} with J_e alone, {_holes(jp2)} with J_p2; by the paper's rules "
                f"{_holes(rules_je)} and {_holes(rules_jp2)}",
                both_ways(_shape_gap(je, jp2) > 2, _shape_gap(rules_je, rules_jp2) > 2),
            ),
            (
                "... with more uniform contact stress",
                f"peak spread {p(je.peak_spread('initial'))} initially, {p(spread[je.name])} with J_e alone, "
                f"{p(spread[jp2.name])} with J_p2; J_p2 {percent(jp2.change('uniformity_dual'))}, J_e "
                f"{percent(jp2.change('strain_energy'))}; by the paper's rules {p(spread[rules_je.name])} and "
                f"{p(spread[rules_jp2.name])}",
                both_ways(spread[jp2.name] < spread[je.name], spread[rules_jp2.name] < spread[rules_je.name]),
            ),
        ),
        "With the volume held J_p2 has little influence: J_e alone already ends with a peak spread of "
        f"{p(spread[je.name])}, and at the end 50 J_p2 is "
        f"{p(50 * jp2.last['uniformity_dual'] / jp2.last['objective'])} of J.\n",
        *(
            f"The run {run.name} ends after {len(run.history) - 1} shapes: the next one is rejected "
            f"({run.end}), and the paper's rules have no shorter step.\n"
            for run in (rules_je, rules_jp2)
            if run.end
        ),
        album.comparison(je, "J_e alone, volume held"),
        album.comparison(jp2, "J_e + 50 J_p2, volume held"),
        album.comparison(rules_je, "J_e alone, the paper's rules"),
        album.comparison(rules_jp2, "J_e + 50 J_p2, the paper's rules"),
        album.copied(je, "pressures_final.svg", "J_e alone"),
        album.copied(jp2, "pressures_final.svg", "J_e + 50 J_p2"),
        album.curves(
            "holes48_je.svg",
            "Strain energy, 48 holes",
            "J_e, 8 positions [J/m]",
            ("J_e alone", je.column("strain_energy")),
            ("J_e + 50 J_p2", jp2.column("strain_energy")),
            ("J_e alone, paper's rules", rules_je.column("strain_energy")),
            ("J_e + 50 J_p2, paper's rules", rules_jp2.column("strain_energy")),
        ),
    )


def holes_108(r: Runs, album: Album) -> str:
    run, rules = r["holes108_je"], r["rules_holes108_je"]
    return joined(
        "The 108 holes form three rings of 36 (47 mm apart in both directions), in 36 sectors. The shape repeats with "
        "every hole, so this is the smallest possible sector; 8 positions per sector are 288 per turn. With 12 sectors "
        "of three holes in each ring, neighbouring holes could become different, but they start equal, and 8 positions "
        "per sector would be three times as coarse.\n",
        "The paper's third picture is a shape in three dimensions, which is not reproduced: the commands and the case "
        "file are in 2D, plane strain, and cannot run a shape that varies along the axle. The solver itself is tested "
        "in 3D as a library, on coarse grids.\n",
        claims(
            ("J_e alone finds a stiffer design (2D)", *_stiffer(run, rules)),
            ("a shape in 3D", "not computed", "not examined"),
        ),
        f"The holes of the three rings become {_holes(run)} with the volume held, and {_holes(rules)} by the paper's "
        "rules.\n",
        album.comparison(run, "108 holes, volume held"),
        album.comparison(rules, "108 holes, the paper's rules"),
        album.curves(
            "holes108_je.svg",
            "Strain energy, 108 holes",
            "J_e, 8 positions [J/m]",
            ("volume held", run.column("objective")),
            ("the paper's rules", rules.column("objective")),
        ),
    )
