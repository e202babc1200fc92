"""Figs 10 and 11: strain energy alone, with the volume held and by the paper's rules."""

from .family import Family, Verdict, both, judged, over
from .section import Album, Runs, both_ways, claims, joined, sizes, table, told, ways


def _lengthens(family: Family) -> Verdict:
    return both(
        judged(lambda length: length > 82, family.of(lambda run: run.holes[0].length)),
        judged(lambda ratio: ratio > 1.3, family.of(lambda run: run.holes[0].length / run.holes[0].width)),
    )


def _course(name: str, family: Family) -> tuple[str, ...]:
    return (
        name,
        f"{family.run.first['objective']:.2f}",
        family.last("objective").text(2, "J/m"),
        family.change("objective").change(),
        f"{100 * family.run.first['volume fraction']:.2f} %",
        family.last("volume fraction").percent(2),
        sizes(family),
    )


def energy_alone(r: Runs, album: Album) -> str:
    ours, rules, more, friction = r["uniform_je"], r["rules_je"], r["more_material"], r["friction"]
    start, more_start = ours.run.first["objective"], more.run.first["objective"]
    fall, drift = ours.change("objective"), rules.change("volume fraction")
    largest_volume = rules.of(lambda run: max(run.column("volume fraction")) / run.first["volume fraction"] - 1)
    same_volume = rules.of(lambda run: run.last["objective"] / more_start - 1)
    rough = over(
        lambda a, b: max(
            abs(a.holes[0].length - b.holes[0].length), abs(a.holes[0].width - b.holes[0].width)
        ),
        ours,
        friction,
    )
    by_friction = over(lambda a, b: b.last["objective"] / a.last["objective"] - 1, ours, friction)
    length = lambda family: family.of(lambda run: run.holes[0].length).text(0, "mm")  # noqa: E731
    width = lambda family: family.of(lambda run: run.holes[0].width).text(0, "mm")  # noqa: E731

    return joined(
        table(
            ["run", "J_e first [J/m]", "J_e last", "change", "material first", "material last", "hole"],
            _course("volume held, accepted steps", ours),
            _course("the paper's rules", rules),
            _course("volume held near the final volume of the paper's rules", more),
            _course("volume held, friction 0.3", friction),
        ),
        claims(
            (
                "the holes become longer radially",
                ways(
                    f"80 mm round holes become {length(ours)} long and {width(ours)} wide",
                    f"{length(rules)} long and {width(rules)} wide",
                ),
                both_ways(_lengthens(ours), _lengthens(rules)),
            ),
            (
                "J_e falls over 100 iterations at constant volume",
                f"{fall.change()} in {len(ours.run.history) - 1} shapes (then converged), volume "
                f"{ours.change('volume fraction').change(4)}",
                told(judged(lambda change: change < -0.17, fall)),
            ),
            (
                "section 4: the rule lambda_k keeps the volume",
                f"volume {drift.change()} at the end, maximum {largest_volume.change()}; J_e "
                f"{rules.change('objective').change()}",
                told(judged(lambda change: abs(change) < 0.01, drift)),
            ),
            (
                "section 5.1: friction does not change the optimal shape",
                f"with F = 0.3 the hole's length and width change by at most {rough.text(1, 'mm')}, J_e of the last "
                f"shape by {by_friction.change(2)}",
                told(judged(lambda gap: gap < 2, rough)),
            ),
        ),
        f"By the paper's rules J_e changes by {rules.change('objective').change()}. The added material alone accounts "
        f"for {100 * (more_start / start - 1):+.1f} %: round holes with a radius of 33.4 mm leave a material fraction "
        f"of {more.last('volume fraction').text(4)}, close to that at the end of the runs by the paper's rules "
        f"({rules.last('volume fraction').text(4)}), and have J_e = {more_start:.2f} J/m. Relative to these "
        f"round holes, the shapes by the paper's rules change J_e by {same_volume.change()}, and the best shape of "
        f"that volume by {more.change('objective').change()} ({more.last('objective').text(2, 'J/m')} instead of "
        f"{rules.last('objective').text(2, 'J/m')}). With the volume held "
        f"({ours.last('volume fraction').text(4)}), J_e falls from {start:.2f} to "
        f"{ours.last('objective').text(2, 'J/m')}.\n",
        "The paper publishes neither its step nor its smoothing; 0.2 cells and tau = 0.1 cells² are used here. Without "
        "any smoothing, its rules give ragged edges.\n",
        "Vertical displacement (Fig. 10), volume held:\n",
        album.copied(ours.run, "shapes/shape_0000_displacement.svg", "Initial shape"),
        album.copied(ours.run, "shapes/shape_0020_displacement.svg", "Volume held, shape 20"),
        album.copied(ours.run, "displacement.svg", f"Volume held, shape {len(ours.run.history) - 1}, the last"),
        "By the paper's rules:\n",
        album.copied(rules.run, "shapes/shape_0020_displacement.svg", "The paper's rules, shape 20"),
        album.copied(rules.run, "shapes/shape_0100_displacement.svg", "The paper's rules, shape 100"),
        album.curves(
            "energy_alone_je.svg",
            "Strain energy (Fig. 11)",
            "J_e, 8 positions [J/m]",
            ("volume held", ours.run.column("objective")),
            ("the paper's rules", rules.run.column("objective")),
            ("held at 76.4 %", more.run.column("objective")),
        ),
        album.curves(
            "energy_alone_volume.svg",
            "Volume",
            "material in the ring [-]",
            ("volume held", ours.run.column("volume fraction")),
            ("the paper's rules", rules.run.column("volume fraction")),
        ),
        album.copied(ours.run, "stress.svg", "Von Mises stress of the last shape, volume held"),
    )
