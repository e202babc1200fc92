"""Many designs of one case."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from . import _core
from ._pieces import Client, DesignProgress, Settings, run_in_pieces
from .case import Case

Designs = dict[str, Any]
"""The content of explore.json or sweep.json: the designs in their order, with their numbers."""


def explore(
    case: Case,
    folder: str | PathLike[str] | None = None,
    *,
    starts: int = 60,
    seed: int = 1,
    keeps_sectors: bool = False,
    quantities: Sequence[str] = ("stiffness", "run_out"),
    threads: int = 1,
    executor: Executor | None = None,
    workers: int = 1,
    client: Client | None = None,
    checkpoint_seconds: float = 60,
    on_progress: Callable[[DesignProgress], object] | None = None,
) -> Designs:
    """Optimizes the case from random starts, and ranks the designs: ``wheelwright explore``.

    Existing results in the folder are read, interrupted runs continued. Ctrl-C saves and stops.

    Args:
        folder: of the results; by default that of the case's runs with ``-explore`` or ``-sweep`` appended.
        keeps_sectors: only numbers of holes that are multiples of the case's sectors.
        quantities: by which designs are ranked and plotted.
        threads: of one process: one for each run, or more if there is no memory for so many runs at once.
        executor: starts `workers` processes that share the runs, on this machine or on others that see the folder:
            a ``ProcessPoolExecutor``, ``dask.distributed.Client(...).get_executor()``, an ``MPIPoolExecutor``.
        workers: their number.
        client: a ``dask.distributed.Client``, or again any executor, whose workers do **not** see the folder: they are
            given the files of a design as bytes, and send them back with their results.
        checkpoint_seconds: how often workers of the client send the files of a design, with a checkpoint: at the first
            shape after this time. A worker that dies costs the shapes after that.
        on_progress: called each time they have sent files; ``print`` tells how far the designs are.

    Raises:
        ValueError: both an executor and a client.
        RunError: another process runs one of the designs, which a client's workers cannot wait for.
    """
    plan = _core.exploration(case._core, starts, seed, keeps_sectors, list(quantities))
    where = case._core.folder + "-explore" if folder is None else folder
    return _run(where, plan, threads, _Workers(executor, workers, client, checkpoint_seconds, on_progress))


def sweep(
    case: Case,
    folder: str | PathLike[str] | None,
    keys: Mapping[str, Sequence[float]],
    *,
    quantities: Sequence[str] = ("stiffness", "run_out"),
    threads: int = 1,
    executor: Executor | None = None,
    workers: int = 1,
    client: Client | None = None,
    checkpoint_seconds: float = 60,
    on_progress: Callable[[DesignProgress], object] | None = None,
) -> Designs:
    """Optimizes the case for every combination of values of some keys: ``wheelwright sweep``.

    The other arguments are those of `explore`.
    """
    values = [(key, [float(value) for value in some]) for key, some in keys.items()]
    plan = _core.swept(case._core, values, list(quantities))
    where = case._core.folder + "-sweep" if folder is None else folder
    return _run(where, plan, threads, _Workers(executor, workers, client, checkpoint_seconds, on_progress))


class _Workers(NamedTuple):
    """Who runs the designs: this process, an executor's workers that see the folder, or a client's that do not."""

    executor: Executor | None
    n: int
    client: Client | None
    checkpoint_seconds: float
    on_progress: Callable[[DesignProgress], object] | None


def _run(folder: str | PathLike[str], plan: _core.DesignPlan, threads: int, workers: _Workers) -> Designs:
    if workers.executor is not None and workers.client is not None:
        raise ValueError("give either an executor, whose workers see the folder, or a client")
    place = Path(folder).resolve()
    if workers.client is not None:
        _core.write_plan(str(folder), plan)
        told = workers.on_progress or (lambda progress: None)
        run_in_pieces(place, plan, workers.client, Settings(workers.checkpoint_seconds, threads, told))
    elif workers.executor is not None:
        _core.write_plan(str(folder), plan)
        _work_together(str(place), threads, workers.executor, workers.n)
    else:
        _core.run_plan(str(folder), plan, threads)
    designs: Designs = json.loads(_core.collect(str(folder), plan))
    return designs


def _work_together(folder: str, threads: int, executor: Executor, workers: int) -> None:
    """Waits until one worker has ended all designs; raises what all workers raised, if none has."""
    futures = [executor.submit(_work, folder, threads, number) for number in range(workers)]
    failures = [failure for future in futures if (failure := future.exception()) is not None]
    if len(failures) == len(futures):
        raise failures[0]


def _work(folder: str, threads: int, number: int) -> None:
    """Runs the designs of a plan in a worker process. To Dask, tasks of equal arguments are one: they need a number."""
    del number
    _core.run_plan(folder, _core.plan_in(folder), threads)
