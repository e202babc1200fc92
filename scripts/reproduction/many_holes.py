"""Figs 22 and 23: 48 and 108 holes."""

import math

from .family import Family, Values, judged, over
from .runs import Run
from .section import Album, Runs, both_ways, claims, joined, sizes, told, ways


def _shape_gap(a: Run, b: Run) -> float:
    """Largest difference of their holes' lengths and widths [mm]; infinite if the holes are other ones."""
    if len(a.holes) != len(b.holes):
        return math.inf
    return max(max(abs(x.length - y.length), abs(x.width - y.width)) for x, y in zip(a.holes, b.holes))


def _least_gap(values: Values) -> str:
    return f"by at least {values.low:.1f} mm" if math.isfinite(values.low) else "in number"


def _stiffer(family: Family, rules: Family) -> tuple[str, str]:
    """What is measured of the fall of J_e, and the verdict."""
    falls = [f.change("strain_energy") for f in (family, rules)]
    drifts = [f.change("volume fraction") for f in (family, rules)]
    return (
        ways(
            f"J_e {falls[0].change()} in {len(family.run.history) - 1} shapes, volume {drifts[0].change(4)}",
            f"{falls[1].change()}, volume {drifts[1].change()}",
        ),
        both_ways(*(judged(lambda fall: fall < -0.1, values) for values in falls)),
    )


def _ends(name: str, family: Family) -> str:
    """How many of the runs had to stop before their last shape, and why."""
    early = [run for run in family.members if run.end]
    reasons = ", ".join(sorted({run.end for run in early}))
    return (
        f"Of the {len(family.members)} runs of {name} by the paper's rules, {len(early) or 'none'} end before their last "
        "shape" + (f", because the next one is rejected ({reasons}) and the paper's rules have no shorter step" if early else "")
        + ".\n"
    )


def holes_48(r: Runs, album: Album) -> str:
    je, jp2 = r["holes48_je"], r["holes48_jp2"]
    rules_je, rules_jp2 = r["rules_holes48_je"], r["rules_holes48_jp2"]
    spread = {family.name: family.of(lambda run: run.peak_spread("final")) for family in (je, jp2, rules_je, rules_jp2)}
    gaps = [over(_shape_gap, je, jp2), over(_shape_gap, rules_je, rules_jp2)]
    evener = [
        Values(value / spread[alone.name].mean for value in spread[with_jp2.name])
        for alone, with_jp2 in ((je, jp2), (rules_je, rules_jp2))
    ]
    share = jp2.of(lambda run: 50 * run.last["uniformity_dual"] / run.last["objective"])
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
                ways(
                    f"holes of {sizes(je)} with J_e alone, {sizes(jp2)} with J_p2",
                    f"{sizes(rules_je)} and {sizes(rules_jp2)}, which differ {_least_gap(gaps[1])}",
                ),
                both_ways(*(judged(lambda gap: gap > 2, values) for values in gaps)),
            ),
            (
                "... with more uniform contact stress",
                ways(
                    f"peak spread {100 * je.run.peak_spread('initial'):.1f} % initially, {spread[je.name].percent()} "
                    f"with J_e alone, {spread[jp2.name].percent()} with J_p2; J_p2 "
                    f"{jp2.change('uniformity_dual').change()}, J_e {jp2.change('strain_energy').change()}",
                    f"{spread[rules_je.name].percent(2)} and {spread[rules_jp2.name].percent(2)}, a ratio of "
                    f"{evener[1].text(2)}",
                ),
                both_ways(*(judged(lambda ratio: ratio < 1, values) for values in evener)),
            ),
        ),
        "With the volume held J_p2 has little influence: J_e alone already ends with a peak spread of "
        f"{spread[je.name].percent()}, and at the end 50 J_p2 is {share.percent()} of J.\n",
        _ends("J_e alone", rules_je),
        _ends("J_e + 50 J_p2", rules_jp2),
        album.comparison(je.run, "J_e alone, volume held"),
        album.comparison(jp2.run, "J_e + 50 J_p2, volume held"),
        album.comparison(rules_je.run, "J_e alone, the paper's rules"),
        album.comparison(rules_jp2.run, "J_e + 50 J_p2, the paper's rules"),
        album.copied(je.run, "pressures_final.svg", "J_e alone"),
        album.copied(jp2.run, "pressures_final.svg", "J_e + 50 J_p2"),
        album.curves(
            "holes48_je.svg",
            "Strain energy, 48 holes",
            "J_e, 8 positions [J/m]",
            ("J_e alone", je.run.column("strain_energy")),
            ("J_e + 50 J_p2", jp2.run.column("strain_energy")),
            ("J_e alone, paper's rules", rules_je.run.column("strain_energy")),
            ("J_e + 50 J_p2, paper's rules", rules_jp2.run.column("strain_energy")),
        ),
    )


def holes_108(r: Runs, album: Album) -> str:
    ours, rules = r["holes108_je"], r["rules_holes108_je"]
    solid, section, extruded = r["holes108_je_3d"], r["holes108_je_section"], r["holes108_je_3d_of_holes108_je_section"]
    gain = over(lambda a, b: a.last["strain_energy"] / b.last["strain_energy"] - 1, solid, extruded)
    widened = [family.last("volume fraction").percent(2) for family in (solid, extruded)]
    return joined(
        "The 108 holes form three rings of 36 (47 mm apart in both directions), in 36 sectors. The shape repeats with "
        "every hole, so this is the smallest possible sector; 8 positions per sector are 288 per turn. With 12 sectors "
        "of three holes in each ring, neighbouring holes could become different, but they start equal, and 8 positions "
        "per sector would be three times as coarse.\n",
        "The paper's third picture is a shape in three dimensions, of which it tells neither the width nor the grid. Here "
        "the wheel is 120 mm wide, its side faces are free, and the grid has 38 x 288 cells, 4 along the axle, which makes "
        "a million unknowns. Its section is optimized in the plane too, on the same grid, and evaluated in three "
        "dimensions with the same width: the difference is what the third dimension gains.\n",
        claims(
            ("J_e alone finds a stiffer design (2D)", *_stiffer(ours, rules)),
            (
                "J_e alone finds a stiffer design (3D)",
                f"J_e {solid.change('strain_energy').change()} in {len(solid.run.history) - 1} shapes, volume "
                f"{solid.change('volume fraction').change(4)}",
                told(judged(lambda fall: fall < -0.1, solid.change("strain_energy"))),
            ),
            (
                "(not in the paper) the shape in 3D is stiffer than that of the plane with the same volume",
                f"J_e {solid.last('strain_energy').text(3)} J at a volume of {widened[0]}, compared with "
                f"{extruded.last('strain_energy').text(3)} J at {widened[1]}: {gain.change()}",
                told(judged(lambda change: change < 0, gain)),
            ),
        ),
        f"The holes of the three rings become {sizes(ours)} with the volume held, and {sizes(rules)} by the paper's "
        "rules.\n",
        album.comparison(ours.run, "108 holes, volume held"),
        album.comparison(rules.run, "108 holes, the paper's rules"),
        "In three dimensions the holes merge into grooves round the whole wheel, and the material between rim and tread "
        "gathers in discs across the axle. The discs are about one cell thick along the axle, so that their number and "
        "thickness depend on the grid: this optimum is not resolved. A minimum thickness of the walls "
        "(`optimizer.minimum_wall`) cannot set that of the discs, because the bands at rim and tread must be as thick.\n",
        album.comparison(solid.run, "108 holes in 3D, volume held"),
        album.copied(solid.run, "stress.svg", "The last shape in 3D, loaded, coloured by von Mises stress"),
        album.comparison(section.run, "Its section, optimized in the plane on the same grid"),
        album.curves(
            "holes108_je.svg",
            "Strain energy, 108 holes",
            "J_e, 8 positions [J/m]",
            ("volume held", ours.run.column("objective")),
            ("the paper's rules", rules.run.column("objective")),
            ("in 3D, per metre of width", [energy / 0.12 for energy in solid.run.column("objective")]),
        ),
        "The full size of the run in 3D, two million unknowns, is not part of this page. `check` estimates 3.5 s and "
        "1.3 GB for its first shape on a core, and at most 24 s and 5.4 GB for shapes with grooves:\n",
        "    sed -e 's/^angular_cells = .*/angular_cells = 360/' -e 's/^axial_cells = .*/axial_cells = 6/' \\\n"
        "        cases/paper/holes108_je_3d.toml > full.toml\n    wheelwright run full.toml\n",
    )
