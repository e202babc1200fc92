"""Figs 16 to 21: uniformity of the contact stress over the load positions."""

from .runs import Run
from .section import Album, Runs, both_ways, claims, joined, percent, table, verdict, verdicts

objectives = {  # by the paper's figure
    16: ("J_e alone", "je"),
    17: ("J_e + 6 J_p1", "jp1"),
    18: ("J_e + 100 J_p2", "jp2_100"),
    20: ("J_e + 10 J_p2", "jp2_10"),
    21: ("J_e + 1000 J_p2", "jp2_1000"),
}


class _Findings:
    """What the claims are about, of one way of descent, by the paper's figures."""

    def __init__(self, runs: dict[int, Run]):
        self.runs = runs
        self.spread = {n: run.peak_spread("final") for n, run in runs.items()}
        self.band = {n: band(run) for n, run in runs.items()}
        self.fall = {
            17: runs[17].change("uniformity_annulus"),
            18: runs[18].change("uniformity_dual"),
        }

    def evened(self, number: int) -> bool:
        """Whether the spread is at least a quarter smaller than with J_e alone."""
        return self.spread[number] < 0.75 * self.spread[16]

    def dearer(self, quantity: str) -> float:
        """How much more alpha_2 = 1000 costs than 100."""
        return self.runs[21].last[quantity] / self.runs[18].last[quantity] - 1


def band(run: Run) -> float:
    """Material between the holes and the tread [mm]."""
    return 340 - run.holes[-1].outer_radius


def _row(name: str, run: Run) -> tuple[str, ...]:
    return (
        name,
        f"{run.last['strain_energy']:.2f} J/m",
        f"{100 * run.last['volume fraction']:.2f} %",
        f"{100 * run.peak_spread('final'):.1f} %",
        f"{100 * run.curve_deviation('final'):.1f} %",
        f"{run.last['mean_travel'] * 1e3:.4f} mm",
        f"{band(run):.1f} mm",
    )


def _relative(values: list[float]) -> list[float]:
    return [v / values[0] for v in values]


def uniformity(r: Runs, album: Album) -> str:
    ours = _Findings({n: r[f"uniform_{name}"] for n, (_, name) in objectives.items()})
    rules = _Findings({n: r[f"rules_{name}"] for n, (_, name) in objectives.items()})
    balanced, coarse = r["uniform_jp1_balanced"], r["contact_nitsche_1"]
    je, jp1, jp2 = ours.runs[16], ours.runs[17], ours.runs[18]
    initial = je.peak_spread("initial")
    balanced_spread, balanced_fall = balanced.peak_spread("final"), balanced.change("uniformity_annulus")
    balance = 100 * jp2.first["uniformity_dual"] / balanced.first["uniformity_annulus"]
    coarse_spread = coarse.peak_spread("final")
    p = lambda value: f"{100 * value:.1f} %"  # noqa: E731

    return joined(
        "The peak spread is (largest - smallest) / mean of the peak pressures of the 8 positions; more than 5 % counts "
        "as significant. The deviation of the curves is the root mean square of pressure minus mean pressure (73), "
        "divided by the root mean square of the mean pressure.\n",
        table(
            ["objective (Fig.)", "J_e", "material", "peak spread", "deviation of the curves", "mean travel",
             "material outside the holes"],
            (
                "initial shape",
                f"{je.first['strain_energy']:.2f} J/m",
                f"{100 * je.first['volume fraction']:.2f} %",
                p(initial),
                p(je.curve_deviation("initial")),
                f"{je.first['mean_travel'] * 1e3:.4f} mm",
                "30.0 mm",
            ),
            *(_row(f"{name} ({n})", ours.runs[n]) for n, (name, _) in objectives.items()),
            _row("J_e + J_p1 balanced by (83) (17)", balanced),
            _row("J_e alone, unrefined cells at the tread", coarse),
            *(_row(f"{name} ({n}), the paper's rules", rules.runs[n]) for n, (name, _) in objectives.items()),
        ),
        claims(
            (
                "Fig. 16: J_e alone leaves a significant disparity over the positions",
                f"peak spread {p(initial)} for the initial shape, {p(ours.spread[16])} for the best shape of J_e at "
                f"constant volume, {p(rules.spread[16])} by the paper's rules",
                both_ways(ours.spread[16] > 0.05, rules.spread[16] > 0.05),
            ),
            (
                "alpha_1 = 6 and alpha_2 = 100 balance (83) at the first iteration",
                f"(83) gives alpha_1 = {balance:.1f}",
                verdict(abs(balance / 6 - 1) < 0.2),
            ),
            (
                "Fig. 17: J_p1 reduces the disparity significantly (by at least a quarter)",
                f"from {p(ours.spread[16])} to {p(ours.spread[17])} with alpha_1 = 6, to {p(balanced_spread)} with "
                f"alpha_1 by (83); by the paper's rules from {p(rules.spread[16])} to {p(rules.spread[17])}",
                verdicts(
                    ("with alpha_1 = 6", ours.evened(17)),
                    ("by (83)", balanced_spread < 0.75 * ours.spread[16]),
                    ("by the paper's rules", rules.evened(17)),
                ),
            ),
            (
                "Fig. 18: so does J_p2",
                f"from {p(ours.spread[16])} to {p(ours.spread[18])}; by the paper's rules from {p(rules.spread[16])} to "
                f"{p(rules.spread[18])}",
                both_ways(ours.evened(18), rules.evened(18)),
            ),
            (
                "the holes move away from the tread",
                f"material outside the holes {ours.band[16]:.1f} mm with J_e alone, {ours.band[17]:.1f} mm with "
                f"6 J_p1, {band(balanced):.1f} mm with J_p1 by (83), {ours.band[18]:.1f} mm with J_p2; by the paper's "
                f"rules {rules.band[16]:.1f}, {rules.band[17]:.1f} (6 J_p1), {rules.band[18]:.1f} mm",
                both_ways(*(min(f.band[17], f.band[18]) > f.band[16] + 0.5 for f in (ours, rules))),
            ),
            (
                "the holes move away slightly more with J_p1 than with J_p2",
                f"{ours.band[17]:.1f} mm (alpha_1 = 6) or {band(balanced):.1f} mm (by (83)), compared with "
                f"{ours.band[18]:.1f} mm; by the paper's rules {rules.band[17]:.1f} compared with "
                f"{rules.band[18]:.1f} mm",
                verdicts(
                    ("with alpha_1 = 6", ours.band[17] > ours.band[18]),
                    ("by (83)", band(balanced) > ours.band[18]),
                    ("by the paper's rules", rules.band[17] > rules.band[18]),
                ),
            ),
            (
                "Fig. 19: J_p2 falls proportionally more than J_p1",
                f"J_p1 {percent(ours.fall[17])} (alpha_1 = 6), {percent(balanced_fall)} (by (83)); J_p2 "
                f"{percent(ours.fall[18])}; by the paper's rules {percent(rules.fall[17])} and "
                f"{percent(rules.fall[18])}",
                verdicts(
                    ("with alpha_1 = 6", ours.fall[18] < ours.fall[17]),
                    ("by (83)", ours.fall[18] < balanced_fall),
                    ("by the paper's rules", rules.fall[18] < rules.fall[17]),
                ),
            ),
            (
                "Fig. 20: alpha_2 = 10 has little effect on the uniformity",
                f"peak spread {p(ours.spread[20])}, compared with {p(ours.spread[16])} with J_e alone; by the paper's "
                f"rules {p(rules.spread[20])} compared with {p(rules.spread[16])}",
                both_ways(not ours.evened(20), not rules.evened(20)),
            ),
            (
                "Fig. 21: alpha_2 = 1000 improves the uniformity strongly, at the cost of J_e and deflection",
                f"peak spread {p(ours.spread[21])}; J_e {percent(ours.dearer('strain_energy'))} and travel "
                f"{percent(ours.dearer('mean_travel'))} relative to alpha_2 = 100; by the paper's rules "
                f"{p(rules.spread[21])}, {percent(rules.dearer('strain_energy'))} and "
                f"{percent(rules.dearer('mean_travel'))}",
                both_ways(
                    *(
                        f.evened(21) and f.dearer("strain_energy") > 0 and f.dearer("mean_travel") > 0
                        for f in (ours, rules)
                    )
                ),
            ),
        ),
        "The verdict on Fig. 16 is based on the peak pressures. If the whole curves are compared, whose ends move with "
        f"the position, a deviation of {p(je.curve_deviation('final'))} remains with J_e alone, and alpha_2 = 100 "
        f"reduces it only to {p(jp2.curve_deviation('final'))}. J_e alone already increases the material between holes "
        f"and tread from 30 mm to {ours.band[16]:.0f} mm, which removes most of the disparity of the initial shape. "
        "The volume drift of the paper's rules does not restore the disparity: the added material thickens the tread "
        f"to {rules.band[16]:.0f} mm. The grid, however, may explain it. With unrefined cells at the tread there are "
        "2.3 cells per contact patch instead of 9, and practically the best shape of J_e (with J_e = "
        f"{coarse.last['strain_energy']:.2f} J/m) shows a spread of {p(coarse_spread)}, which is an error of the grid "
        "and not a property of the wheel. The paper publishes neither its mesh nor whether its shapes had converged; "
        "either could explain its Fig. 16.\n",
        "By the paper's rules little disparity remains for Figs 17, 18 and 20 to remove: because of the added "
        f"material, J_e alone ends at {p(rules.spread[16])}. There J_p1 and J_p2 change the shapes and the deviation "
        "of the curves only slightly "
        f"({p(rules.runs[16].curve_deviation('final'))} with J_e alone, {p(rules.runs[17].curve_deviation('final'))} "
        f"with 6 J_p1, {p(rules.runs[18].curve_deviation('final'))} with 100 J_p2).\n",
        f"For epsilon = L = 10 mm, (83) gives alpha_1 = {balance:.1f}. The paper's value of 6 is therefore "
        f"{balance / 6:.0f} times too small to match its alpha_2. The row with (83) shows J_p1 with the weight that "
        "the paper intended.\n",
        album.copied(je, "pressures_initial.svg", "Initial shape"),
        *(
            album.comparison(ours.runs[n], f"{name} (Fig. {n}), volume held")
            + album.copied(ours.runs[n], "pressures_final.svg", f"{name} (Fig. {n}), volume held")
            + album.copied(rules.runs[n], "pressures_final.svg", f"{name} (Fig. {n}), the paper's rules")
            for n, (name, _) in objectives.items()
        ),
        album.comparison(balanced, "J_e + J_p1 balanced by (83) (Fig. 17)")
        + album.copied(balanced, "pressures_final.svg", "J_e + J_p1 balanced by (83) (Fig. 17)"),
        "The shapes by the paper's rules:\n",
        *(album.comparison(rules.runs[n], f"{objectives[n][0]} (Fig. {n}), the paper's rules") for n in (16, 17, 18)),
        album.curves(
            "uniformity_jp.svg",
            "Uniformity of the contact stress (Fig. 19)",
            "J_p / J_p of the first shape [-]",
            ("J_p1 (alpha_1 = 6)", _relative(jp1.column("uniformity_annulus"))),
            ("J_p1 (alpha_1 by (83))", _relative(balanced.column("uniformity_annulus"))),
            ("J_p2 (alpha_2 = 100)", _relative(jp2.column("uniformity_dual"))),
            ("J_p1, paper's rules", _relative(rules.runs[17].column("uniformity_annulus"))),
            ("J_p2, paper's rules", _relative(rules.runs[18].column("uniformity_dual"))),
        ),
    )
