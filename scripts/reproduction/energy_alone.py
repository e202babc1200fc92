"""Figs 10 and 11: strain energy alone, with the volume held and by the paper's rules."""

from .section import Album, Runs, both_ways, claims, joined, percent, table, verdict


def _lengthens(run) -> bool:
    return run.holes[0].length > 82 and run.holes[0].length > 1.3 * run.holes[0].width


def energy_alone(r: Runs, album: Album) -> str:
    ours, rules, more, friction = r["uniform_je"], r["rules_je"], r["more_material"], r["friction"]
    hole, rules_hole, rough_hole = ours.holes[0], rules.holes[0], friction.holes[0]
    start = ours.first["objective"]
    added = more.first["objective"] / start - 1
    same_volume = rules.last["objective"] / more.first["objective"] - 1
    largest_volume = max(rules.column("volume fraction")) / rules.first["volume fraction"] - 1
    rough = max(abs(hole.length - rough_hole.length), abs(hole.width - rough_hole.width))

    def course(name, run):
        return (
            name,
            f"{run.first['objective']:.2f}",
            f"{run.last['objective']:.2f} J/m",
            percent(run.change("objective")),
            f"{100 * run.first['volume fraction']:.2f} %",
            f"{100 * run.last['volume fraction']:.2f} %",
            f"{run.holes[0]} mm",
        )

    return joined(
        table(
            ["run", "J_e first", "J_e last", "change", "material first", "material last", "hole"],
            course("volume held, accepted steps", ours),
            course("the paper's rules", rules),
            course("volume held near the final volume of the paper's rules", more),
            course("volume held, friction 0.3", friction),
        ),
        claims(
            (
                "the holes become longer radially",
                f"80 mm round holes become {hole.length:.0f} mm long and {hole.width:.0f} mm wide; by the paper's rules "
                f"{rules_hole.length:.0f} mm and {rules_hole.width:.0f} mm",
                both_ways(_lengthens(ours), _lengthens(rules)),
            ),
            (
                "J_e falls over 100 iterations at constant volume",
                f"{percent(ours.change('objective'))} in {len(ours.history) - 1} shapes (then converged), volume "
                f"{percent(ours.change('volume fraction'), 4)}",
                verdict(ours.change("objective") < -0.17),
            ),
            (
                "section 4: the rule lambda_k keeps the volume",
                f"volume {percent(rules.change('volume fraction'))} at the end, maximum {percent(largest_volume)}; J_e "
                f"{percent(rules.change('objective'))}",
                verdict(abs(rules.change("volume fraction")) < 0.01),
            ),
            (
                "section 5.1: friction does not change the optimal shape",
                f"with F = 0.3 the hole's length and width change by at most {rough:.2f} mm, J_e of the last shape by "
                f"{percent(friction.last['objective'] / ours.last['objective'] - 1, 2)}",
                verdict(rough < 2),
            ),
        ),
        f"By the paper's rules J_e changes by {percent(rules.change('objective'))}. The added material alone accounts "
        f"for {percent(added)}: round holes with a radius of 33.4 mm leave a material fraction of "
        f"{more.last['volume fraction']:.4f}, close to that at the end of the run by the paper's rules "
        f"({rules.last['volume fraction']:.4f}), and have J_e = {more.first['objective']:.2f} J/m. Relative to these "
        f"round holes, the shape by the paper's rules changes J_e by {percent(same_volume)}, and the best shape of "
        f"that volume by {percent(more.change('objective'))} ({more.last['objective']:.2f} J/m instead of "
        f"{rules.last['objective']:.2f} J/m). With the volume held ({ours.last['volume fraction']:.4f}), J_e falls "
        f"from {start:.2f} to {ours.last['objective']:.2f} J/m.\n",
        "The paper publishes neither its step nor its smoothing; 0.2 cells and tau = 0.1 cells² are used here. Without "
        "any smoothing, its rules give ragged edges.\n",
        "Vertical displacement (Fig. 10), volume held:\n",
        album.copied(ours, "shapes/shape_0000_displacement.svg", "Initial shape"),
        album.copied(ours, "shapes/shape_0020_displacement.svg", "Volume held, shape 20"),
        album.copied(ours, "displacement.svg", f"Volume held, shape {len(ours.history) - 1}, the last"),
        "By the paper's rules:\n",
        album.copied(rules, "shapes/shape_0020_displacement.svg", "The paper's rules, shape 20"),
        album.copied(rules, "shapes/shape_0100_displacement.svg", "The paper's rules, shape 100"),
        album.curves(
            "energy_alone_je.svg",
            "Strain energy (Fig. 11)",
            "J_e, 8 positions [J/m]",
            ("volume held", ours.column("objective")),
            ("the paper's rules", rules.column("objective")),
            ("held at 76.4 %", more.column("objective")),
        ),
        album.curves(
            "energy_alone_volume.svg",
            "Volume",
            "material in the ring [-]",
            ("volume held", ours.column("volume fraction")),
            ("the paper's rules", rules.column("volume fraction")),
        ),
        album.copied(ours, "stress.svg", "Von Mises stress of the last shape, volume held"),
    )
