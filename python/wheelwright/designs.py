"""Many designs of one case."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from os import PathLike
from pathlib import Path
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
    executor: Executor | None = None,
    workers: int = 1,
) -> Designs:
    """Optimizes the case from random starts, and ranks the designs: ``wheelwright explore``.

    Existing results in the folder are read, interrupted runs continued. Ctrl-C saves and stops.

    Args:
        keeps_sectors: only numbers of holes that are multiples of the case's sectors.
        quantities: by which designs are ranked and plotted.
        threads: of one process: one for each run, or more if there is no memory for so many runs at once.
        executor: starts `workers` processes that share the runs, on this machine or on others that see the folder:
            a ``ProcessPoolExecutor``, ``dask.distributed.Client(...).get_executor()``, an ``MPIPoolExecutor``.
        workers: their number.
    """
    plan = _core.exploration(case._core, starts, seed, keeps_sectors, list(quantities))
    return _run(folder, plan, threads, executor, workers)


def sweep(
    case: Case,
    folder: str | PathLike[str],
    keys: Mapping[str, Sequence[float]],
    *,
    quantities: Sequence[str] = ("stiffness", "run_out"),
    threads: int = 1,
    executor: Executor | None = None,
    workers: int = 1,
) -> Designs:
    """Optimizes the case for every combination of values of some keys: ``wheelwright sweep``.

    The other arguments are those of `explore`.
    """
    values = [(key, [float(value) for value in some]) for key, some in keys.items()]
    plan = _core.swept(case._core, values, list(quantities))
    return _run(folder, plan, threads, executor, workers)


def _run(
    folder: str | PathLike[str], plan: _core.DesignPlan, threads: int, executor: Executor | None, workers: int
) -> Designs:
    if executor is None:
        _core.run_plan(str(folder), plan, threads)
    else:
        _core.write_plan(str(folder), plan)
        _work_together(str(Path(folder).resolve()), threads, executor, workers)
    designs: Designs = json.loads(_core.collect(str(folder), plan))
    return designs


def _work_together(folder: str, threads: int, executor: Executor, workers: int) -> None:
    """Waits until one worker has ended all designs; raises what all workers raised, if none has."""
    futures = [executor.submit(_work, folder, threads) for _ in range(workers)]
    failures = [failure for future in futures if (failure := future.exception()) is not None]
    if len(failures) == len(futures):
        raise failures[0]


def _work(folder: str, threads: int) -> None:
    """Runs the designs of a plan in a worker process."""
    _core.run_plan(folder, _core.plan_in(folder), threads)
