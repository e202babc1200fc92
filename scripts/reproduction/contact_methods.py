"""Figs 12 to 15: penalty against Nitsche's method."""

from .family import Family, Values, judged, over
from .runs import Run
from .section import Album, Runs, both_ways, claims, joined, sizes, table, ways

Courses = dict[tuple[str, int], Family]  # by method and gamma_0


def _courses(r: Runs, prefix: str) -> Courses:
    return {(m, g): r[f"{prefix}_{m}_{g}"] for g in (1, 10) for m in ("nitsche", "penalty")}


def _row(way: str, method: str, gamma: int, family: Family) -> tuple[str, ...]:
    return (
        way,
        method,
        f"{gamma}",
        f"{family.run.first['objective']:.3f}",
        family.last("objective").text(3, "J/m"),
        family.last("volume fraction").percent(2),
        Values(1e3 * travel for travel in family.last("mean_travel")).text(4, "mm"),
        _penetration(family).text(1, "µm"),
        sizes(family),
    )


def _penetration(family: Family) -> Values:
    return family.of(lambda run: 1e6 * run.deepest_penetration())


def _gap(a: Run, b: Run) -> float:
    """Of the holes' lengths [mm]."""
    return abs(a.holes[0].length - b.holes[0].length)


def _rise(a: Run, b: Run) -> float:
    """Of the last J_e from one run to another, relative."""
    return b.last["objective"] / a.last["objective"] - 1


class _Findings:
    """What the claims are about, of one way of descent."""

    def __init__(self, families: Courses):
        pairs = {g: (families["nitsche", g], families["penalty", g]) for g in (1, 10)}
        self.shape_gap = {g: over(_gap, *pair) for g, pair in pairs.items()}
        self.apart = {g: over(_rise, *pair) for g, pair in pairs.items()}
        self.by_gamma = {m: over(_rise, families[m, 1], families[m, 10]) for m in ("nitsche", "penalty")}
        self.deflection = over(lambda a, b: b.last["mean_travel"] / a.last["mean_travel"] - 1, *pairs[1])
        self.closer_at_10 = over(
            lambda n1, p1, n10, p10: abs(_rise(n10, p10)) / abs(_rise(n1, p1)), *pairs[1], *pairs[10]
        )
        self.steadier = over(
            lambda n1, n10, p1, p10: abs(_rise(n1, n10)) / abs(_rise(p1, p10)),
            *(families[m, g] for m in ("nitsche", "penalty") for g in (1, 10)),
        )
        self.unrest = families["nitsche", 1].of(lambda run: _span(run.column("objective")[-10:]))


def _span(values: list[float]) -> float:
    return max(values) - min(values)


def contact_methods(r: Runs, album: Album) -> str:
    ours, rules = _courses(r, "contact"), _courses(r, "rules")
    a, b = _Findings(ours), _Findings(rules)
    volumes = Values(v for family in rules.values() for v in family.last("volume fraction"))
    per_percent = over(
        lambda held, drifted: (held.last["objective"] - drifted.last["objective"])
        / (100 * (drifted.last["volume fraction"] - held.last["volume fraction"])),
        ours["nitsche", 10],
        rules["nitsche", 10],
    )
    at_first = {
        m: ours[m, 10].run.first["objective"] / ours[m, 1].run.first["objective"] - 1 for m in ("nitsche", "penalty")
    }

    return joined(
        table(
            ["descent", "contact", "gamma_0", "J_e first [J/m]", "J_e last", "material last",
             "mean travel of the rim", "deepest penetration", "hole"],
            *(_row("volume held", *key, family) for key, family in ours.items()),
            *(_row("the paper's rules", *key, family) for key, family in rules.items()),
        ),
        claims(
            (
                "Fig. 12: at gamma = E/h both methods give nearly the same shape",
                ways(
                    f"the holes' lengths differ by {a.shape_gap[1].text(2, 'mm')}",
                    f"by {b.shape_gap[1].text(1, 'mm')}",
                ),
                both_ways(*(judged(lambda gap: gap < 2, f.shape_gap[1]) for f in (a, b))),
            ),
            (
                "penalty has a slightly larger deflection",
                ways(
                    f"travel of the rim {a.deflection.change()}, including the penetration", b.deflection.change()
                ),
                both_ways(*(judged(lambda rise: rise > 0, f.deflection) for f in (a, b))),
            ),
            (
                "Fig. 13: penalty underestimates J_e, by interpenetration",
                ways(f"J_e {a.apart[1].change(2)}", b.apart[1].change())
                + f"; penalty penetrates by {_penetration(ours['penalty', 1]).text(0, 'µm')}, Nitsche by "
                f"{_penetration(ours['nitsche', 1]).text(0, 'µm')}",
                both_ways(*(judged(lambda rise: rise < 0, f.apart[1]) for f in (a, b))),
            ),
            (
                "Fig. 14: at 10 E/h the deformed shapes are very close",
                ways(
                    f"the holes' lengths differ by {a.shape_gap[10].text(2, 'mm')}",
                    f"by {b.shape_gap[10].text(1, 'mm')}",
                ),
                both_ways(*(judged(lambda gap: gap < 2, f.shape_gap[10]) for f in (a, b))),
            ),
            (
                "Fig. 15: at 10 E/h J_e almost agrees (it is apart by at most a third of that at E/h)",
                ways(
                    f"J_e {a.apart[10].change(2)}, {a.closer_at_10.text(2)} of that at E/h",
                    f"{b.apart[10].change()}, {b.closer_at_10.text(2)} of that at E/h",
                ),
                both_ways(*(judged(lambda ratio: ratio < 1 / 3, f.closer_at_10) for f in (a, b))),
            ),
            (
                "Fig. 15: J_e hardly depends on gamma with Nitsche's method, but it does with penalty (at least "
                "three times as much)",
                ways(
                    f"from gamma_0 = 1 to 10: Nitsche {a.by_gamma['nitsche'].change(2)}, penalty "
                    f"{a.by_gamma['penalty'].change(2)}, a ratio of {a.steadier.text(2)}",
                    f"{b.by_gamma['nitsche'].change()} and {b.by_gamma['penalty'].change()}, a ratio of "
                    f"{b.steadier.text(2)}",
                ),
                both_ways(*(judged(lambda ratio: ratio < 1 / 3, f.steadier) for f in (a, b))),
            ),
        ),
        "The runs by the paper's rules end with different amounts of material, "
        f"{volumes.percent()}, also those of one case. J_e falls by {per_percent.text(2, 'J/m')} for every percent of "
        "the ring that is added (between the last shapes of Nitsche's method at gamma_0 = 10). These runs do not "
        f"settle either: over the last 10 shapes of Nitsche's method at gamma_0 = 1, J_e varies by "
        f"{b.unrest.text(1, 'J/m')}, compared with {a.unrest.text(3, 'J/m')} when the volume is held. On the first "
        "shape, which is the same for all runs, J_e changes from gamma_0 = 1 to 10 by "
        f"{100 * at_first['nitsche']:+.2f} % with Nitsche's method and by {100 * at_first['penalty']:+.2f} % with "
        "penalty.\n",
        "The cells at the tread are not refined here, because gamma depends on their size.\n",
        *(
            album.copied(
                ours[method, gamma].run, "displacement.svg", f"{text}, {parameter}, volume held (Fig. {number})"
            )
            for number, gamma, parameter in ((12, 1, "gamma = E/h"), (14, 10, "gamma = 10 E/h"))
            for method, text in (("penalty", "Penalty"), ("nitsche", "Nitsche's method"))
        ),
        album.curves(
            "contact_methods_je.svg",
            "Strain energy by contact method, volume held (Figs 13, 15)",
            "J_e, 8 positions [J/m]",
            *((f"{m}, gamma_0 = {g}", family.run.column("objective")) for (m, g), family in ours.items()),
        ),
        album.curves(
            "contact_methods_rules_je.svg",
            "Strain energy by contact method, the paper's rules (Figs 13, 15)",
            "J_e, 8 positions [J/m]",
            *((f"{m}, gamma_0 = {g}", family.run.column("objective")) for (m, g), family in rules.items()),
        ),
    )
