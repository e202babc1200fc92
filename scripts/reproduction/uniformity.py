"""Figs 16 to 21: uniformity of the contact stress over the load positions."""

from .family import Family, Values, Verdict, both, judged, over
from .runs import Run
from .section import Album, Runs, both_ways, claims, joined, sizes, table, told, verdicts, ways

objectives = {  # by the paper's figure
    16: ("J_e alone", "je"),
    17: ("J_e + 6 J_p1", "jp1"),
    18: ("J_e + 100 J_p2", "jp2_100"),
    20: ("J_e + 10 J_p2", "jp2_10"),
    21: ("J_e + 1000 J_p2", "jp2_1000"),
}


def _band(run: Run) -> float:
    """Material between the holes and the tread [mm]."""
    return 340 - run.holes[-1].outer_radius


def _spread(run: Run) -> float:
    return run.peak_spread("final")


class _Findings:
    """What the claims are about, of one way of descent, by the paper's figures."""

    def __init__(self, families: dict[int, Family]):
        self.families = families
        self.spread = {n: family.of(_spread) for n, family in families.items()}
        self.band = {n: family.of(_band) for n, family in families.items()}
        self.fall = {17: families[17].change("uniformity_annulus"), 18: families[18].change("uniformity_dual")}

    def remains(self, number: int) -> Values:
        """Of the mean spread with J_e alone."""
        return _remains(self.families[number], self.families[16])

    def evened(self, number: int) -> Verdict:
        return _evened(self.remains(number))

    def gain(self, number: int, other: int) -> Values:
        """Material between the holes and the tread, more than on the mean with another objective [mm]."""
        return _gain(self.families[number], self.families[other])

    def farther(self, number: int, other: int, least: float = 0) -> Verdict:
        """Whether its holes are farther from the tread than those of another one, by more than `least` [mm]."""
        return _farther(self.gain(number, other), least)

    def dearer(self, quantity: str) -> Values:
        """How much more alpha_2 = 1000 costs than 100 on the mean."""
        usual = self.families[18].last(quantity).mean
        return self.families[21].of(lambda run: run.last[quantity] / usual - 1)

    def deviation(self, number: int) -> str:
        return self.families[number].of(lambda run: run.curve_deviation("final")).percent()


def _remains(family: Family, alone: Family) -> Values:
    usual = alone.of(_spread).mean
    return family.of(lambda run: _spread(run) / usual)


def _evened(remains: Values) -> Verdict:
    """Whether the spread is at least a quarter smaller than with J_e alone."""
    return judged(lambda ratio: ratio < 0.75, remains)


def _gain(family: Family, other: Family) -> Values:
    usual = other.of(_band).mean
    return family.of(lambda run: _band(run) - usual)


def _farther(gain: Values, least: float = 0) -> Verdict:
    return judged(lambda gap: gap > least, gain)


def _falls_more(jp2: Family, jp1: Family) -> Verdict:
    changes = over(
        lambda a, b: (1 + a.change("uniformity_dual")) / (1 + b.change("uniformity_annulus")), jp2, jp1
    )
    return judged(lambda ratio: ratio < 1, changes)


def _not(verdict: Verdict) -> Verdict:
    opposite = {Verdict.confirmed: Verdict.contradicted, Verdict.contradicted: Verdict.confirmed}
    return opposite.get(verdict, verdict)


def _row(name: str, family: Family) -> tuple[str, ...]:
    return (
        name,
        family.last("strain_energy").text(2, "J/m"),
        family.last("volume fraction").percent(2),
        family.of(_spread).percent(),
        family.of(lambda run: run.curve_deviation("final")).percent(),
        Values(1e3 * travel for travel in family.last("mean_travel")).text(4, "mm"),
        family.of(_band).text(1, "mm"),
    )


def _relative(values: list[float]) -> list[float]:
    return [v / values[0] for v in values]


def uniformity(r: Runs, album: Album) -> str:
    ours = _Findings({n: r[f"uniform_{name}"] for n, (_, name) in objectives.items()})
    rules = _Findings({n: r[f"rules_{name}"] for n, (_, name) in objectives.items()})
    balanced, poisson, coarse = r["uniform_jp1_balanced"], r["uniform_jp2_poisson"], r["contact_nitsche_1"]
    je, jp1, jp2 = ours.families[16], ours.families[17], ours.families[18]
    first = je.run.first
    initial = 100 * je.run.peak_spread("initial")
    balanced_spread, balanced_band = balanced.of(_spread).percent(), balanced.of(_band).text(1, "mm")
    weight = over(lambda a, b: 100 * a.first["uniformity_dual"] / b.first["uniformity_annulus"], jp2, balanced)
    spread = lambda findings, n: findings.spread[n].percent()  # noqa: E731
    band = lambda findings, n: findings.band[n].text(1, "mm")  # noqa: E731

    return joined(
        "The peak spread is (largest - smallest) / mean of the peak pressures of the 8 positions; more than 5 % counts "
        "as significant. The deviation of the curves is the root mean square of pressure minus mean pressure (73), "
        "divided by the root mean square of the mean pressure.\n",
        table(
            ["objective (Fig.)", "J_e", "material", "peak spread", "deviation of the curves", "mean travel",
             "material outside the holes"],
            (
                "initial shape",
                f"{first['strain_energy']:.2f} J/m",
                f"{100 * first['volume fraction']:.2f} %",
                f"{initial:.1f} %",
                f"{100 * je.run.curve_deviation('initial'):.1f} %",
                f"{first['mean_travel'] * 1e3:.4f} mm",
                "30.0 mm",
            ),
            *(_row(f"{name} ({n})", ours.families[n]) for n, (name, _) in objectives.items()),
            _row("J_e + J_p1 balanced by (83) (17)", balanced),
            _row("J_e + 150.8 J_p2 by Poisson's problem (Remark 7)", poisson),
            _row("J_e alone, unrefined cells at the tread", coarse),
            *(_row(f"{name} ({n}), the paper's rules", rules.families[n]) for n, (name, _) in objectives.items()),
        ),
        claims(
            (
                "Fig. 16: J_e alone leaves a significant disparity over the positions",
                f"peak spread {initial:.1f} % for the initial shape, {spread(ours, 16)} for the best shape of J_e at "
                f"constant volume, {spread(rules, 16)} by the paper's rules",
                both_ways(*(judged(lambda value: value > 0.05, f.spread[16]) for f in (ours, rules))),
            ),
            (
                "alpha_1 = 6 and alpha_2 = 100 balance (83) at the first iteration",
                f"(83) gives alpha_1 = {weight.text(1)}",
                told(judged(lambda value: abs(value / 6 - 1) < 0.2, weight)),
            ),
            (
                "Fig. 17: J_p1 reduces the disparity significantly (by at least a quarter)",
                ways(
                    f"from {spread(ours, 16)} to {spread(ours, 17)} with alpha_1 = 6, to {balanced_spread} with alpha_1 "
                    "by (83)",
                    f"{rules.remains(17).text(2)} times that of J_e alone, {spread(rules, 16)}",
                ),
                verdicts(
                    ("with alpha_1 = 6", ours.evened(17)),
                    ("by (83)", _evened(_remains(balanced, je))),
                    ("by the paper's rules", rules.evened(17)),
                ),
            ),
            (
                "Fig. 18: so does J_p2",
                ways(
                    f"from {spread(ours, 16)} to {spread(ours, 18)}",
                    f"{rules.remains(18).text(2)} times that of J_e alone",
                ),
                both_ways(ours.evened(18), rules.evened(18)),
            ),
            (
                "the holes move away from the tread (by at least 0.5 mm)",
                ways(
                    f"material outside the holes {band(ours, 16)} with J_e alone, {band(ours, 17)} with 6 J_p1, "
                    f"{balanced_band} with J_p1 by (83), {band(ours, 18)} with J_p2",
                    f"{band(rules, 16)} with J_e alone, {rules.gain(17, 16).text(1, 'mm', '+')} with 6 J_p1, "
                    f"{rules.gain(18, 16).text(1, 'mm', '+')} with J_p2",
                ),
                both_ways(*(both(f.farther(17, 16, 0.5), f.farther(18, 16, 0.5)) for f in (ours, rules))),
            ),
            (
                "the holes move away slightly more with J_p1 than with J_p2",
                ways(
                    f"{band(ours, 17)} (alpha_1 = 6) or {balanced_band} (by (83)), compared with {band(ours, 18)}",
                    f"a difference of {rules.gain(17, 18).text(1, 'mm', '+')}",
                ),
                verdicts(
                    ("with alpha_1 = 6", ours.farther(17, 18)),
                    ("by (83)", _farther(_gain(balanced, jp2))),
                    ("by the paper's rules", rules.farther(17, 18)),
                ),
            ),
            (
                "Fig. 19: J_p2 falls proportionally more than J_p1",
                ways(
                    f"J_p1 {ours.fall[17].change()} (alpha_1 = 6), "
                    f"{balanced.change('uniformity_annulus').change()} (by (83)); J_p2 {ours.fall[18].change()}",
                    f"{rules.fall[17].change()} and {rules.fall[18].change()}",
                ),
                verdicts(
                    ("with alpha_1 = 6", _falls_more(jp2, jp1)),
                    ("by (83)", _falls_more(jp2, balanced)),
                    ("by the paper's rules", _falls_more(rules.families[18], rules.families[17])),
                ),
            ),
            (
                "Fig. 20: alpha_2 = 10 has little effect on the uniformity (less than a quarter)",
                ways(
                    f"peak spread {spread(ours, 20)}, compared with {spread(ours, 16)} with J_e alone",
                    f"{rules.remains(20).text(2)} times that of J_e alone",
                ),
                both_ways(_not(ours.evened(20)), _not(rules.evened(20))),
            ),
            (
                "Fig. 21: alpha_2 = 1000 improves the uniformity strongly, at the cost of J_e and deflection",
                ways(
                    f"peak spread {spread(ours, 21)}; J_e {ours.dearer('strain_energy').change()} and travel "
                    f"{ours.dearer('mean_travel').change()} relative to alpha_2 = 100",
                    f"{rules.remains(21).text(2)} times that of J_e alone, {rules.dearer('strain_energy').change()} and "
                    f"{rules.dearer('mean_travel').change()}",
                ),
                both_ways(
                    *(
                        both(
                            f.evened(21),
                            *(judged(lambda rise: rise > 0, f.dearer(q)) for q in ("strain_energy", "mean_travel")),
                        )
                        for f in (ours, rules)
                    )
                ),
            ),
        ),
        "The verdict on Fig. 16 is based on the peak pressures. If the whole curves are compared, whose ends move with "
        f"the position, a deviation of {ours.deviation(16)} remains with J_e alone, and alpha_2 = 100 reduces it only "
        f"to {ours.deviation(18)}. J_e alone already increases the material between holes and tread from 30 mm to "
        f"{ours.band[16].text(0, 'mm')}, which removes most of the disparity of the initial shape. "
        "The volume drift of the paper's rules does not restore the disparity: the added material thickens the tread "
        f"to {rules.band[16].text(0, 'mm')}. The grid, however, may explain it. With unrefined cells at the tread there "
        "are 2.3 cells per contact patch instead of 9, and practically the best shape of J_e (with J_e = "
        f"{coarse.last('strain_energy').text(2, 'J/m')}) shows a spread of {coarse.of(_spread).percent()}, which is an "
        "error of the grid and not a property of the wheel. The paper publishes neither its mesh nor whether its "
        "shapes had converged; either could explain its Fig. 16.\n",
        "By the paper's rules little disparity remains for Figs 17, 18 and 20 to remove: because of the added "
        f"material, J_e alone ends at {spread(rules, 16)}. There J_p1 and J_p2 change the deviation of the curves only "
        f"slightly ({rules.deviation(16)} with J_e alone, {rules.deviation(17)} with 6 J_p1, {rules.deviation(18)} with "
        "100 J_p2).\n",
        f"For epsilon = L = 10 mm, (83) gives alpha_1 = {weight.text(1)}. The paper's value of 6 is therefore "
        f"{Values(value / 6 for value in weight).text(0)} times too small to match its alpha_2. The row with (83) shows "
        "J_p1 with the weight that the paper intended.\n",
        "Remark 7 allows Poisson's problem in place of elasticity (68) for the norm of J_p2. With Young's modulus as its "
        "coefficient it makes J_p2 of the first shape smaller by the factor "
        f"{over(lambda a, b: a.first['uniformity_dual'] / b.first['uniformity_dual'], jp2, poisson).text(3)}, by which "
        "alpha_2 was multiplied. The choice changes the optimum little: the hole is "
        f"{sizes(poisson)} instead of {sizes(jp2)}, J_e differs by "
        f"{over(lambda a, b: b.last['strain_energy'] / a.last['strain_energy'] - 1, jp2, poisson).change(2)}, and the "
        f"peak spread is {poisson.of(_spread).percent()} instead of {spread(ours, 18)}. "
        f"J_p2 changes by {poisson.change('uniformity_dual').change()} in the one norm and by "
        f"{ours.fall[18].change()} in the other.\n",
        album.copied(je.run, "pressures_initial.svg", "Initial shape"),
        *(
            album.comparison(ours.families[n].run, f"{name} (Fig. {n}), volume held")
            + album.copied(ours.families[n].run, "pressures_final.svg", f"{name} (Fig. {n}), volume held")
            + album.copied(rules.families[n].run, "pressures_final.svg", f"{name} (Fig. {n}), the paper's rules")
            for n, (name, _) in objectives.items()
        ),
        album.comparison(balanced.run, "J_e + J_p1 balanced by (83) (Fig. 17)")
        + album.copied(balanced.run, "pressures_final.svg", "J_e + J_p1 balanced by (83) (Fig. 17)"),
        album.comparison(poisson.run, "J_e + 150.8 J_p2 by Poisson's problem (Remark 7)")
        + album.copied(poisson.run, "pressures_final.svg", "J_e + 150.8 J_p2 by Poisson's problem (Remark 7)"),
        "The shapes by the paper's rules:\n",
        *(
            album.comparison(rules.families[n].run, f"{objectives[n][0]} (Fig. {n}), the paper's rules")
            for n in (16, 17, 18)
        ),
        album.curves(
            "uniformity_jp.svg",
            "Uniformity of the contact stress (Fig. 19)",
            "J_p / J_p of the first shape [-]",
            ("J_p1 (alpha_1 = 6)", _relative(jp1.run.column("uniformity_annulus"))),
            ("J_p1 (alpha_1 by (83))", _relative(balanced.run.column("uniformity_annulus"))),
            ("J_p2 (alpha_2 = 100)", _relative(jp2.run.column("uniformity_dual"))),
            ("J_p1, paper's rules", _relative(rules.families[17].run.column("uniformity_annulus"))),
            ("J_p2, paper's rules", _relative(rules.families[18].run.column("uniformity_dual"))),
        ),
    )
