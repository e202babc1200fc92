"""Figs 12 to 15: penalty against Nitsche's method."""

from .runs import Run
from .section import Album, Runs, both_ways, claims, joined, percent, table

Courses = dict[tuple[str, int], Run]  # by method and gamma_0


def _courses(r: Runs, prefix: str) -> Courses:
    return {(m, g): r[f"{prefix}_{m}_{g}"] for g in (1, 10) for m in ("nitsche", "penalty")}


def _row(way: str, method: str, gamma: int, run: Run) -> tuple[str, ...]:
    hole = run.holes[0]
    return (
        way,
        method,
        f"{gamma}",
        f"{run.first['objective']:.3f}",
        f"{run.last['objective']:.3f} J/m",
        f"{100 * run.last['volume fraction']:.2f} %",
        f"{run.last['mean_travel'] * 1e3:.4f} mm",
        f"{run.deepest_penetration() * 1e6:.1f} µm",
        f"{hole.length:.1f} x {hole.width:.1f} mm",
    )


class _Findings:
    """What the claims are about, of one way of descent."""

    def __init__(self, runs: Courses):
        last = {key: run.last["objective"] for key, run in runs.items()}
        holes = {key: run.holes[0] for key, run in runs.items()}
        travel = {key: run.last["mean_travel"] for key, run in runs.items()}
        self.shape_gap = {g: abs(holes["penalty", g].length - holes["nitsche", g].length) for g in (1, 10)}
        self.deflection = travel["penalty", 1] / travel["nitsche", 1] - 1
        self.apart = {g: last["penalty", g] / last["nitsche", g] - 1 for g in (1, 10)}
        first = {key: run.first["objective"] for key, run in runs.items()}
        self.at_first = {m: first[m, 10] / first[m, 1] - 1 for m in ("nitsche", "penalty")}
        self.volume = {key: run.last["volume fraction"] for key, run in runs.items()}
        self.more_material = self.volume["nitsche", 10] - self.volume["nitsche", 1]
        self.difference = last["nitsche", 1] - last["nitsche", 10]
        course = runs["nitsche", 1].column("objective")[-10:]
        self.unrest = max(course) - min(course)
        self.by_gamma = {m: last[m, 10] / last[m, 1] - 1 for m in ("nitsche", "penalty")}


def contact_methods(r: Runs, album: Album) -> str:
    ours, rules = _courses(r, "contact"), _courses(r, "rules")
    a, b = _Findings(ours), _Findings(rules)
    ends = [runs["nitsche", 10].last for runs in (ours, rules)]
    per_percent = (ends[0]["objective"] - ends[1]["objective"]) / (
        100 * (ends[1]["volume fraction"] - ends[0]["volume fraction"])
    )
    deep = {m: 1e6 * ours[m, 1].deepest_penetration() for m in ("nitsche", "penalty")}

    def ways(first: str, second: str) -> str:
        return f"{first}; by the paper's rules {second}"

    return joined(
        table(
            ["descent", "contact", "gamma_0", "J_e first", "J_e last", "material last", "mean travel of the rim",
             "deepest penetration", "hole"],
            *(_row("volume held", *key, run) for key, run in ours.items()),
            *(_row("the paper's rules", *key, run) for key, run in rules.items()),
        ),
        claims(
            (
                "Fig. 12: at gamma = E/h both methods give nearly the same shape",
                ways(f"the holes' lengths differ by {a.shape_gap[1]:.2f} mm", f"by {b.shape_gap[1]:.2f} mm"),
                both_ways(a.shape_gap[1] < 2, b.shape_gap[1] < 2),
            ),
            (
                "penalty has a slightly larger deflection",
                ways(f"travel of the rim {percent(a.deflection)}, including the penetration", percent(b.deflection)),
                both_ways(a.deflection > 0, b.deflection > 0),
            ),
            (
                "Fig. 13: penalty underestimates J_e, by interpenetration",
                ways(f"J_e {percent(a.apart[1], 2)}", percent(b.apart[1], 2))
                + f"; penalty penetrates by {deep['penalty']:.0f} µm, Nitsche by {deep['nitsche']:.0f} µm",
                both_ways(a.apart[1] < 0, b.apart[1] < 0),
            ),
            (
                "Fig. 14: at 10 E/h the deformed shapes are very close",
                ways(f"the holes' lengths differ by {a.shape_gap[10]:.2f} mm", f"by {b.shape_gap[10]:.2f} mm"),
                both_ways(a.shape_gap[10] < 2, b.shape_gap[10] < 2),
            ),
            (
                "Fig. 15: at 10 E/h J_e almost agrees",
                ways(f"J_e {percent(a.apart[10], 2)}", percent(b.apart[10], 2)),
                both_ways(*(abs(f.apart[10]) < abs(f.apart[1]) / 3 for f in (a, b))),
            ),
            (
                "Fig. 15: J_e hardly depends on gamma with Nitsche's method, but it does with penalty",
                ways(
                    f"from gamma_0 = 1 to 10: Nitsche {percent(a.by_gamma['nitsche'], 2)}, penalty "
                    f"{percent(a.by_gamma['penalty'], 2)}",
                    f"{percent(b.by_gamma['nitsche'], 2)} and {percent(b.by_gamma['penalty'], 2)}",
                ),
                both_ways(*(abs(f.by_gamma["nitsche"]) < abs(f.by_gamma["penalty"]) / 3 for f in (a, b))),
            ),
        ),
        "The runs by the paper's rules end with different amounts of material, "
        f"{100 * min(b.volume.values()):.2f} to {100 * max(b.volume.values()):.2f} %. J_e falls by "
        f"{per_percent:.2f} J/m for every percent of the ring that is added (between the last shapes of Nitsche's "
        "method at gamma_0 = 10). This effect alone would make J_e of Nitsche's two runs differ by "
        f"{per_percent * 100 * b.more_material:.2f} J/m; they differ by {b.difference:.2f} J/m. These runs do not "
        f"settle either: over the last 10 shapes of Nitsche's method at gamma_0 = 1, J_e varies by {b.unrest:.2f} J/m, "
        f"compared with {a.unrest:.3f} J/m when the volume is held. On the first shape, which is the same for all "
        f"runs, J_e changes from gamma_0 = 1 to 10 by {percent(a.at_first['nitsche'], 2)} with Nitsche's method and by "
        f"{percent(a.at_first['penalty'], 2)} with penalty.\n",
        "The cells at the tread are not refined here, because gamma depends on their size.\n",
        *(
            album.copied(ours[method, gamma], "displacement.svg", f"{text}, {parameter}, volume held (Fig. {number})")
            for number, gamma, parameter in ((12, 1, "gamma = E/h"), (14, 10, "gamma = 10 E/h"))
            for method, text in (("penalty", "Penalty"), ("nitsche", "Nitsche's method"))
        ),
        album.curves(
            "contact_methods_je.svg",
            "Strain energy by contact method, volume held (Figs 13, 15)",
            "J_e, 8 positions [J/m]",
            *((f"{m}, gamma_0 = {g}", run.column("objective")) for (m, g), run in ours.items()),
        ),
        album.curves(
            "contact_methods_rules_je.svg",
            "Strain energy by contact method, the paper's rules (Figs 13, 15)",
            "J_e, 8 positions [J/m]",
            *((f"{m}, gamma_0 = {g}", run.column("objective")) for (m, g), run in rules.items()),
        ),
    )
