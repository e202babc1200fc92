"""The figures of the paper: which cases each needs, and what its section of the page says."""

from .contact_methods import contact_methods
from .energy_alone import energy_alone
from .ghost_penalty import ghost_penalty
from .gradient import gradient, level_set
from .many_holes import holes_48, holes_108
from .mesh import mesh
from .section import Figure
from .uniformity import uniformity


def _with_rules(*names: str) -> list[str]:
    """Our cases, and the same by the paper's rules."""
    return [*names, *(f"rules_{name.removeprefix('contact_').removeprefix('uniform_')}" for name in names)]


figures = [
    Figure(range(5, 6), "what is done to the shape gradient", ["one_position", "rules_je", "uniform_je"], gradient),
    Figure(range(6, 7), "the level set", ["uniform_je"], level_set),
    Figure(range(7, 8), "grid, cut grid and solution", ["uniform_je"], mesh),
    Figure(
        range(9, 10),
        "von Mises stress with and without ghost penalty",
        ["ghost_none_p1", "ghost_paper_p1", "ghost_none_p2", "ghost_paper_p2", "ghost_full_p2", "ghost_reference"],
        ghost_penalty,
        may_fail=("ghost_none_p1", "ghost_paper_p1", "ghost_none_p2", "ghost_paper_p2"),
    ),
    Figure(
        range(10, 12),
        "strain energy alone",
        ["uniform_je", "rules_je", "more_material", "friction"],
        energy_alone,
    ),
    Figure(
        range(12, 16),
        "penalty against Nitsche's method",
        _with_rules("contact_nitsche_1", "contact_penalty_1", "contact_nitsche_10", "contact_penalty_10"),
        contact_methods,
    ),
    Figure(
        range(16, 22),
        "uniformity of the contact stress",
        [
            *_with_rules("uniform_je", "uniform_jp1", "uniform_jp2_10", "uniform_jp2_100", "uniform_jp2_1000"),
            "uniform_jp1_balanced",
            "uniform_jp2_poisson",
            "contact_nitsche_1",
        ],
        uniformity,
    ),
    Figure(range(22, 23), "48 holes", _with_rules("holes48_je", "holes48_jp2"), holes_48),
    Figure(
        range(23, 24),
        "108 holes",
        [*_with_rules("holes108_je"), "holes108_je_section", "holes108_je_3d"],
        holes_108,
        shapes=(("holes108_je_3d", "holes108_je_section"),),
    ),
]
