"""The figures of the paper: which cases each needs, and what its section of the page says."""

import math
import shutil
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from .plot import Curve, crop_stress, line_plot
from .runs import Run

pictures = Path("docs/reproduction")
Runs = dict[str, Run]


@dataclass
class Figure:
    numbers: range  # of the paper's figures
    title: str
    cases: list[str]
    section: Callable[[Runs], str]
    may_fail: tuple[str, ...] = ()  # cases whose failure the section tells

    @property
    def label(self) -> str:
        first, last = self.numbers[0], self.numbers[-1]
        return f"{first}" if first == last else f"{first}-{last}"


def claims(*rows: tuple[str, str, str]) -> str:
    """Rows of: what the paper says, what is measured, the verdict."""
    head = "| the paper says | measured here | verdict |\n|---|---|---|\n"
    return head + "".join(f"| {paper} | {measured} | {verdict} |\n" for paper, measured, verdict in rows)


def verdict(holds: bool) -> str:
    return "**confirmed**" if holds else "**contradicted**"


def picture(name: str, text: str) -> str:
    return f"![{text}](reproduction/{name})\n"


def comparison(run: Run, text: str) -> str:
    return copied(run, "comparison.svg", text)


def copied(run: Run, file: str, text: str) -> str:
    shutil.copy(run.folder / file, pictures / f"{run.name}_{file}")
    return picture(f"{run.name}_{file}", text)


def stress(run: Run, text: str) -> str:
    name = f"{run.name}_stress.svg"
    crop_stress(run.folder / "stress.svg", pictures / name, text)
    return picture(name, text)


def curves(name: str, title: str, y_name: str, *lines: tuple[str, list[float]]) -> str:
    line_plot(pictures / name, title, y_name, [Curve(*line) for line in lines])
    return picture(name, title)


def percent(value: float, digits: int = 1) -> str:
    return f"{100 * value:+.{digits}f} %"


def joined(*parts: str) -> str:
    """The parts with an empty line between; paragraphs are wrapped, tables and pictures are not."""
    return "\n".join(part if part[0] in "|!" else textwrap.fill(part, 115) + "\n" for part in parts)


def ghost_penalty(r: Runs) -> str:
    names = ["ghost_none_p1", "ghost_paper_p1", "ghost_none_p2", "ghost_paper_p2", "ghost_full_p2"]
    stresses = {n: r[n].largest_inner_stress() for n in names if not r[n].failure}
    reference = r["ghost_reference"].largest_inner_stress()
    texts = {n: f"{stresses[n] / 1e6:.3g} MPa" if n in stresses else f"`{r[n].failure}`" for n in names}
    cured = [n for n in ("ghost_paper_p1", "ghost_paper_p2") if n in stresses]
    return joined(
        "The largest von Mises stress over the 8 positions, at nodes more than 25 mm inside the tread. The same "
        f"wheel on a grid three times as fine has {reference / 1e6:.3g} MPa. Holes of 37.7 mm leave a sliver in "
        "a cut cell; most radii do not, and then no penalty is missed.\n",
        claims(
            (
                "without ghost penalty the stress is badly wrong on small cuts",
                f"xi = 0: {texts['ghost_none_p1']} with degree 1, {texts['ghost_none_p2']} with degree 2",
                verdict(all(stresses.get(n, math.inf) > 2 * reference for n in ("ghost_none_p1", "ghost_none_p2"))),
            ),
            (
                "xi = 1e-3 in (81) cures it, degree 1",
                texts["ghost_paper_p1"],
                verdict("ghost_paper_p1" in cured and abs(stresses["ghost_paper_p1"] / reference - 1) < 0.2),
            ),
            (
                "xi = 1e-3 in (81) cures it, degree 2",
                texts["ghost_paper_p2"],
                verdict("ghost_paper_p2" in cured and abs(stresses["ghost_paper_p2"] / reference - 1) < 0.2),
            ),
            ("(not in the paper) the full penalty, xi = 1e-4, degree 2", texts["ghost_full_p2"], "the default here"),
        ),
        "(81) penalizes the jump of the stress alone. For degree 2 it leaves quadratic modes of slivers with "
        "almost no stiffness, down to its own rounding errors; the full penalty adds the jump of the second normal "
        "derivative.\n",
        *(
            stress(r[name], text)
            for name, text in (
                ("ghost_none_p1", "Degree 1, no ghost penalty"),
                ("ghost_paper_p1", "Degree 1, ghost penalty (81) with xi = 0.001"),
                ("ghost_none_p2", "Degree 2, no ghost penalty"),
                ("ghost_full_p2", "Degree 2, full ghost penalty with xi = 0.0001"),
            )
            if name in stresses
        ),
        "The colours of these pictures end at the 99th percentile, so that slivers do not darken the rest.\n",
    )


def energy_alone(r: Runs) -> str:
    ours, rules, more = r["uniform_je"], r["rules_of_the_paper"], r["more_material"]
    hole = ours.holes[0]
    volumes = [run.last["volume fraction"] for run in (ours, rules, more)]
    start = ours.first["objective"]
    added = more.first["objective"] / start - 1
    same_volume = rules.last["objective"] / more.first["objective"] - 1
    return joined(
        claims(
            (
                "the holes lengthen radially",
                f"80 mm round holes become {hole.length:.0f} mm long and {hole.width:.0f} mm wide",
                verdict(hole.length > 84 and hole.width < 76),
            ),
            (
                "J_e falls over 100 iterations at constant volume",
                f"{percent(ours.change('objective'))} in {len(ours.history) - 1} shapes (then converged), volume "
                f"{percent(ours.change('volume fraction'), 4)}",
                verdict(ours.change("objective") < -0.17),
            ),
            (
                "section 4: the rule lambda_k keeps the volume",
                f"volume {percent(rules.change('volume fraction'))} at the end, "
                f"{percent(max(rules.column('volume fraction')) / rules.first['volume fraction'] - 1)} at most; J_e "
                f"{percent(rules.change('objective'))}",
                verdict(abs(rules.change("volume fraction")) < 0.01),
            ),
        ),
        f"Of the fall of {percent(rules.change('objective'))} by the paper's rules, {percent(added)} comes with the "
        f"material alone: round holes of 33.4 mm, with {volumes[2]:.4f} of the ring as material like the end of that "
        f"run ({volumes[1]:.4f}), have J_e = {more.first['objective']:.2f} J/m. Against those the shape gains "
        f"{percent(same_volume)}; the best shape of that volume gains {percent(more.change('objective'))} "
        f"({more.last['objective']:.2f} J/m against {rules.last['objective']:.2f} J/m). With the volume held "
        f"({volumes[0]:.4f}) J_e goes from {start:.2f} to {ours.last['objective']:.2f} J/m.\n",
        "The paper publishes neither its step nor its smoothing; 0.2 cells and tau = 0.1 cells² are taken. Without "
        "any smoothing its rules give ragged edges.\n",
        comparison(ours, "Volume held, accepted steps"),
        comparison(rules, "The paper's rules"),
        curves(
            "energy_alone_je.svg",
            "Strain energy (Fig. 11)",
            "J_e, 8 positions [J/m]",
            ("volume held", ours.column("objective")),
            ("the paper's rules", rules.column("objective")),
            ("held at 76.4 %", more.column("objective")),
        ),
        curves(
            "energy_alone_volume.svg",
            "Volume",
            "material in the ring [-]",
            ("volume held", ours.column("volume fraction")),
            ("the paper's rules", rules.column("volume fraction")),
        ),
        stress(ours, "The loaded wheel after the last shape, displacements times 20"),
    )


def contact_methods(r: Runs) -> str:
    keys = {(m, g): r[f"contact_{m}_{g}"] for m in ("nitsche", "penalty") for g in (1, 10)}
    table = "| contact | gamma_0 | J_e first | J_e last | mean travel of the rim | deepest penetration | hole |\n"
    table += "|---|---|---|---|---|---|---|\n"
    for (method, g), run in keys.items():
        hole = run.holes[0]
        table += (
            f"| {method} | {g} | {run.first['objective']:.3f} | {run.last['objective']:.3f} J/m | "
            f"{run.last['mean_travel'] * 1e3:.4f} mm | {run.deepest_penetration() * 1e6:.1f} µm | "
            f"{hole.length:.1f} x {hole.width:.1f} mm |\n"
        )
    last = {key: run.last["objective"] for key, run in keys.items()}
    travel = {key: run.last["mean_travel"] for key, run in keys.items()}
    holes = {key: run.holes[0] for key, run in keys.items()}
    apart = {g: last["penalty", g] / last["nitsche", g] - 1 for g in (1, 10)}
    by_gamma = {m: last[m, 10] / last[m, 1] - 1 for m in ("nitsche", "penalty")}
    shape_gap = abs(holes["penalty", 1].length - holes["nitsche", 1].length)
    return joined(
        table,
        claims(
            (
                "at gamma = E/h both give nearly the same shape",
                f"the holes' lengths differ by {shape_gap:.2f} mm",
                verdict(shape_gap < 2),
            ),
            (
                "penalty has a slightly larger deflection",
                f"travel of the rim {percent(travel['penalty', 1] / travel['nitsche', 1] - 1)}, penetration included",
                verdict(travel["penalty", 1] > travel["nitsche", 1]),
            ),
            (
                "penalty underestimates J_e, by interpenetration",
                f"J_e {percent(apart[1], 2)}; it penetrates by "
                f"{keys['penalty', 1].deepest_penetration() * 1e6:.0f} µm, Nitsche by "
                f"{keys['nitsche', 1].deepest_penetration() * 1e6:.0f} µm",
                verdict(apart[1] < 0),
            ),
            (
                "at 10 E/h both agree",
                f"J_e {percent(apart[10], 2)}",
                verdict(abs(apart[10]) < abs(apart[1]) / 3),
            ),
            (
                "Nitsche's J_e hardly depends on gamma, that of penalty does",
                f"from gamma_0 = 1 to 10: Nitsche {percent(by_gamma['nitsche'], 2)}, penalty "
                f"{percent(by_gamma['penalty'], 2)}",
                verdict(abs(by_gamma["nitsche"]) < abs(by_gamma["penalty"]) / 3),
            ),
        ),
        "Cells at the tread are not refined here, since gamma follows their size.\n",
        curves(
            "contact_methods_je.svg",
            "Strain energy by contact method (Figs 13, 15)",
            "J_e, 8 positions [J/m]",
            *((f"{m}, gamma_0 = {g}", run.column("objective")) for (m, g), run in keys.items()),
        ),
        comparison(keys["penalty", 1], "Penalty, gamma = E/h (Fig. 12)"),
    )


def uniformity(r: Runs) -> str:
    runs = {
        "J_e alone (16)": r["uniform_je"],
        "J_e + 6 J_p1 (17)": r["uniform_jp1"],
        "J_e + J_p1 balanced by (83) (17)": r["uniform_jp1_balanced"],
        "J_e + 10 J_p2 (20)": r["uniform_jp2_10"],
        "J_e + 100 J_p2 (18)": r["uniform_jp2_100"],
        "J_e + 1000 J_p2 (21)": r["uniform_jp2_1000"],
        "J_e alone, the paper's rules (16)": r["rules_of_the_paper"],
        "J_e alone, cells at the tread not refined": r["contact_nitsche_1"],
    }
    table = (
        "| objective (Fig.) | J_e | peak spread | deviation of the curves | mean travel | material outside the "
        "holes |\n|---|---|---|---|---|---|\n"
        f"| initial shape | {r['uniform_je'].first['strain_energy']:.2f} J/m | "
        f"{100 * r['uniform_je'].peak_spread('initial'):.1f} % | "
        f"{100 * r['uniform_je'].curve_deviation('initial'):.1f} % | "
        f"{r['uniform_je'].first['mean_travel'] * 1e3:.4f} mm | 30.0 mm |\n"
    )
    for name, run in runs.items():
        table += (
            f"| {name} | {run.last['strain_energy']:.2f} J/m | {100 * run.peak_spread('final'):.1f} % | "
            f"{100 * run.curve_deviation('final'):.1f} % | {run.last['mean_travel'] * 1e3:.4f} mm | "
            f"{340 - run.holes[-1].outer_radius:.1f} mm |\n"
        )
    je, jp1, jp2 = r["uniform_je"], r["uniform_jp1"], r["uniform_jp2_100"]
    balanced, coarse, rules = r["uniform_jp1_balanced"], r["contact_nitsche_1"], r["rules_of_the_paper"]
    weak, strong = r["uniform_jp2_10"], r["uniform_jp2_1000"]
    spread = {run.name: run.peak_spread("final") for run in runs.values()}
    band = {run.name: 340 - run.holes[-1].outer_radius for run in runs.values()}
    fall1, fall1_balanced = jp1.change("uniformity_annulus"), balanced.change("uniformity_annulus")
    fall2 = jp2.change("uniformity_dual")
    balance = 100 * jp2.first["uniformity_dual"] / balanced.first["uniformity_annulus"]
    initial = je.peak_spread("initial")
    return joined(
        "Peak spread: (largest - smallest) / mean of the peak pressures of the 8 positions; above 5 % it counts as "
        "significant. Deviation of the curves: root mean square of pressure minus mean pressure (73), over that of "
        "the mean.\n",
        table,
        claims(
            (
                "Fig. 16: J_e alone leaves a significant disparity over the positions",
                f"peak spread {100 * initial:.1f} % of the initial shape, {100 * spread[je.name]:.1f} % of the best one "
                f"of J_e at constant volume, {100 * spread[rules.name]:.1f} % by the paper's rules",
                verdict(max(spread[je.name], spread[rules.name]) > 0.05),
            ),
            (
                "alpha_1 = 6 and alpha_2 = 100 balance (83) at the first iteration",
                f"(83) asks for alpha_1 = {balance:.1f}",
                verdict(abs(balance / 6 - 1) < 0.2),
            ),
            (
                "Fig. 17: J_p1 reduces the disparity significantly (by a quarter at least)",
                f"from {100 * spread[je.name]:.1f} % to {100 * spread[jp1.name]:.1f} % with alpha_1 = 6, to "
                f"{100 * spread[balanced.name]:.1f} % with alpha_1 by (83)",
                f"{verdict(spread[jp1.name] < 0.75 * spread[je.name])} with alpha_1 = 6, "
                f"{verdict(spread[balanced.name] < 0.75 * spread[je.name])} by (83)",
            ),
            (
                "Fig. 18: so does J_p2",
                f"from {100 * spread[je.name]:.1f} % to {100 * spread[jp2.name]:.1f} %",
                verdict(spread[jp2.name] < 0.75 * spread[je.name]),
            ),
            (
                "the holes draw away from the tread",
                f"material outside the holes {band[je.name]:.1f} mm with J_e alone, {band[jp1.name]:.1f} mm with "
                f"6 J_p1, {band[balanced.name]:.1f} mm with J_p1 by (83), {band[jp2.name]:.1f} mm with J_p2",
                verdict(min(band[jp1.name], band[jp2.name]) > band[je.name] + 0.5),
            ),
            (
                "the holes draw away a little more with J_p1 than with J_p2",
                f"{band[jp1.name]:.1f} mm (alpha_1 = 6) or {band[balanced.name]:.1f} mm (by (83)) against "
                f"{band[jp2.name]:.1f} mm",
                f"{verdict(band[jp1.name] > band[jp2.name])} with alpha_1 = 6, "
                f"{verdict(band[balanced.name] > band[jp2.name])} by (83)",
            ),
            (
                "Fig. 19: J_p2 falls proportionally more than J_p1",
                f"J_p1 {percent(fall1)} (alpha_1 = 6), {percent(fall1_balanced)} (by (83)); J_p2 {percent(fall2)}",
                f"{verdict(fall2 < fall1)} with alpha_1 = 6, {verdict(fall2 < fall1_balanced)} by (83)",
            ),
            (
                "Fig. 20: alpha_2 = 10 evens out little",
                f"peak spread {100 * spread[weak.name]:.1f} % after {100 * spread[je.name]:.1f} % with J_e alone",
                verdict(spread[jp2.name] < spread[weak.name]),
            ),
            (
                "Fig. 21: alpha_2 = 1000 evens out strongly, at the price of J_e and deflection",
                f"peak spread {100 * spread[strong.name]:.1f} %; J_e "
                f"{percent(strong.last['strain_energy'] / jp2.last['strain_energy'] - 1)} and travel "
                f"{percent(strong.last['mean_travel'] / jp2.last['mean_travel'] - 1)} against alpha_2 = 100",
                verdict(
                    spread[strong.name] < spread[jp2.name]
                    and strong.last["strain_energy"] > jp2.last["strain_energy"]
                    and strong.last["mean_travel"] > jp2.last["mean_travel"]
                ),
            ),
        ),
        f"The verdict on Fig. 16 rests on the peaks. Over the whole curves, whose ends move with the position, "
        f"{100 * je.curve_deviation('final'):.1f} % of deviation are left with J_e alone, and alpha_2 = 100 only makes "
        f"it {100 * jp2.curve_deviation('final'):.1f} %. "
        f"J_e alone already moves the holes from 30 mm to {band[je.name]:.0f} mm inside the tread, and with that most "
        f"of the disparity of the initial shape goes. The volume that drifts by the paper's rules does not bring it "
        f"back: its material thickens the tread to {band[rules.name]:.0f} mm. But on cells at the tread that are not "
        "refined, 2.3 to a contact patch instead of 9, practically the best shape of J_e (its J_e is "
        f"{coarse.last['strain_energy']:.2f} J/m) shows a spread of {100 * spread[coarse.name]:.1f} %, which is the "
        "grid's and not the wheel's. The paper publishes neither its mesh nor whether its shapes had converged; either "
        "could be behind its Fig. 16.\n",
        f"For epsilon = L = 10 mm (83) gives alpha_1 = {balance:.1f}, so the paper's 6 weighs J_p1 "
        f"{balance / 6:.0f} times too lightly beside its alpha_2. The rows by (83) show J_p1 as the paper means it.\n",
        copied(je, "pressures_initial.svg", "Initial shape"),
        *(
            comparison(run, name) + copied(run, "pressures_final.svg", name)
            for name, run in list(runs.items())[:-1]
        ),
        curves(
            "uniformity_jp.svg",
            "Uniformity of the contact stress (Fig. 19)",
            "J_p / J_p of the first shape [-]",
            ("J_p1 (alpha_1 = 6)", _relative(jp1.column("uniformity_annulus"))),
            ("J_p1 (alpha_1 by (83))", _relative(balanced.column("uniformity_annulus"))),
            ("J_p2 (alpha_2 = 100)", _relative(jp2.column("uniformity_dual"))),
        ),
    )


def holes_48(r: Runs) -> str:
    je, jp2 = r["holes48_je"], r["holes48_jp2"]
    spread = [run.peak_spread("final") for run in (je, jp2)]
    return joined(
        "The paper does not say how its 48 holes are arranged. Two rings of 24 are taken, in 24 sectors: their holes "
        "are 70 mm apart radially and 71 mm along the middle circle. 12 k^2 holes in k rings of 12 k always have such "
        "square spacing; 48 and 108 are the numbers for k = 2 and 3. Three rings of 16 would have 47 mm and 106 mm.\n",
        claims(
            (
                "J_e alone finds a stiffer design",
                f"J_e {percent(je.change('strain_energy'))} in {len(je.history) - 1} shapes",
                verdict(je.change("strain_energy") < -0.1),
            ),
            (
                "J_e + 50 J_p2 gives another design, with evener contact stress",
                f"peak spread {100 * je.peak_spread('initial'):.1f} % at first, {100 * spread[0]:.1f} % with J_e alone, "
                f"{100 * spread[1]:.1f} % with J_p2; J_p2 {percent(jp2.change('uniformity_dual'))}, J_e "
                f"{percent(jp2.change('strain_energy'))}",
                verdict(spread[1] < spread[0]),
            ),
        ),
        comparison(je, "J_e alone"),
        comparison(jp2, "J_e + 50 J_p2"),
        copied(je, "pressures_final.svg", "J_e alone"),
        copied(jp2, "pressures_final.svg", "J_e + 50 J_p2"),
    )


def holes_108(r: Runs) -> str:
    run = r["holes108_je"]
    return joined(
        "Three rings of 36 (47 mm apart both ways), in 36 sectors: the shape repeats with every hole, so the smallest "
        "sector, and with 8 positions in it 288 a turn. With 12 sectors of three holes neighbours could differ, but "
        "start equal, and 8 positions would be three times as coarse. 2D alone: runs are not done in 3D.\n",
        claims(
            (
                "J_e alone finds a stiffer design",
                f"J_e {percent(run.change('strain_energy'))} in {len(run.history) - 1} shapes, volume "
                f"{percent(run.change('volume fraction'), 4)}",
                verdict(run.change("strain_energy") < -0.1),
            ),
        ),
        comparison(run, "108 holes"),
        curves("holes108_je.svg", "Strain energy, 108 holes", "J_e, 8 positions [J/m]", ("J_e", run.column("objective"))),
    )


def _relative(values: list[float]) -> list[float]:
    return [v / values[0] for v in values]


figures = [
    Figure(
        range(9, 10),
        "von Mises stress with and without ghost penalty",
        ["ghost_none_p1", "ghost_paper_p1", "ghost_none_p2", "ghost_paper_p2", "ghost_full_p2", "ghost_reference"],
        ghost_penalty,
        may_fail=("ghost_none_p1", "ghost_paper_p1", "ghost_none_p2", "ghost_paper_p2"),
    ),
    Figure(range(10, 12), "strain energy alone", ["uniform_je", "rules_of_the_paper", "more_material"], energy_alone),
    Figure(
        range(12, 16),
        "penalty against Nitsche's method",
        ["contact_nitsche_1", "contact_penalty_1", "contact_nitsche_10", "contact_penalty_10"],
        contact_methods,
    ),
    Figure(
        range(16, 22),
        "uniformity of the contact stress",
        [
            "uniform_je",
            "uniform_jp1",
            "uniform_jp1_balanced",
            "uniform_jp2_10",
            "uniform_jp2_100",
            "uniform_jp2_1000",
            "rules_of_the_paper",
            "contact_nitsche_1",
        ],
        uniformity,
    ),
    Figure(range(22, 23), "48 holes", ["holes48_je", "holes48_jp2"], holes_48),
    Figure(range(23, 24), "108 holes", ["holes108_je"], holes_108),
]
