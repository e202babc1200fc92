"""Many designs of one case."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

from . import _core
from .case import Case

Designs = dict[str, Any]
"""The content of exploration.json or sweep.json: the designs in their order, with their numbers."""


def explore(
    case: Case,
    folder: str | PathLike[str],
    *,
    starts: int = 60,
    seed: int = 1,
    keeps_sectors: bool = False,
    quantities: Sequence[str] = ("stiffness", "run_out"),
    threads: int = 1,
) -> Designs:
    """Optimizes the case from random starts, and ranks the designs: ``wheelwright explore``, in 2D.

    Existing results in the folder are read, interrupted runs continued. Ctrl-C saves and stops.

    Args:
        keeps_sectors: only numbers of holes that are multiples of the case's sectors.
        quantities: by which designs are ranked and plotted.
        threads: the number of concurrent runs.
    """
    text = _core.explore(case._core, str(folder), starts, seed, keeps_sectors, list(quantities), threads)
    designs: Designs = json.loads(text)
    return designs


def sweep(
    case: Case,
    folder: str | PathLike[str],
    keys: Mapping[str, Sequence[float]],
    *,
    quantities: Sequence[str] = ("stiffness", "run_out"),
    threads: int = 1,
) -> Designs:
    """Optimizes the case for every combination of values of some keys: ``wheelwright sweep``, in 2D."""
    values = [(key, [float(value) for value in some]) for key, some in keys.items()]
    designs: Designs = json.loads(_core.sweep(case._core, str(folder), values, list(quantities), threads))
    return designs
