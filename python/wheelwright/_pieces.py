"""Designs run piece by piece by workers that do not see the folder of the results.

A piece is a task: it is given the files of a design's run as bytes, continues the run in a folder of its own to its
first shape after some seconds, and returns the files that it wrote, checkpoint included. The next piece of the design,
on any worker, begins there. So a worker that dies costs the piece that it was working on.
"""

from __future__ import annotations

import json
import os
import tempfile
import uuid
import warnings
from collections.abc import Callable
from concurrent.futures import Executor
from pathlib import Path
from queue import SimpleQueue
from typing import Any, NamedTuple, Protocol

from . import _core

Files = dict[str, bytes]
"""By their paths in the folder."""

_PLAN = "plan.json"
_DESIGNS = "designs"
_MAX_FAILURES = 3
_RESULTS = {".html", ".vtu", ".vtp"}
"""Large files of a run that it writes anew at its end, and never reads."""


class Client(Protocol):
    """A ``dask.distributed.Client``, or an executor of ``concurrent.futures``."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Any:
        """A future of fn(...)."""


class DesignProgress(NamedTuple):
    """How far a design is, when a worker has sent its files."""

    design: str
    """Its name, e.g. ``007``."""
    progression: str
    """``preview`` or ``full``."""
    shape: int | None
    """The newest one that the worker accepted; None if it accepted none."""
    is_over: bool
    """Whether it has a result for this progression."""
    n_left: int
    """Designs of this progression that are not over yet, as far as is known."""

    def __str__(self) -> str:
        where = "no new shape" if self.shape is None else f"shape {self.shape}"
        state = "ended" if self.is_over else "continues"
        return f"{self.progression} of {self.design}: {where}, {state}; {self.n_left} left"


class Settings(NamedTuple):
    """Of the pieces."""

    seconds: float
    threads: int
    on_progress: Callable[[DesignProgress], object]


def run_in_pieces(folder: Path, plan: _core.DesignPlan, client: Client, settings: Settings) -> None:
    """Runs the designs of a folder with a plan until nothing is due, like ``_core.run_plan``."""
    tried: set[tuple[str, str]] = set()
    while True:
        progression, names = _core.due(str(folder), plan, tried)
        if not names:
            return
        locks = [_core.lock_design(str(folder), plan, name) for name in names]
        _Stage(folder, progression, client, settings).run(names)
        locks.clear()
        tried.update((name, progression) for name in names)


class _Stage:
    """Designs that do not depend on each other's results."""

    def __init__(self, folder: Path, progression: str, client: Client, settings: Settings) -> None:
        self._folder = folder
        self._progression = progression
        self._client = client
        self._settings = settings
        self._futures: dict[str, Any] = {}
        self._failures: dict[str, int] = {}
        self._done: SimpleQueue[tuple[str, Any]] = SimpleQueue()

    def run(self, names: list[str]) -> None:
        try:
            for name in names:
                self._submit(name)
            while self._futures:
                self._take(*self._done.get())
        finally:
            for future in self._futures.values():
                future.cancel()

    def _submit(self, name: str) -> None:
        files = files_of(self._folder, name)
        needed = {path: content for path, content in files.items() if Path(path).suffix not in _RESULTS}
        arguments = (needed, name, self._progression, self._settings.seconds, self._settings.threads)
        if isinstance(self._client, Executor):
            future = self._client.submit(run_piece, *arguments)
        else:
            key = f"{self._progression}-{name}-{uuid.uuid4()}"  # by which the dashboard groups tasks
            with warnings.catch_warnings():  # data scattered to a worker, as Dask advises, is lost with it
                warnings.filterwarnings("ignore", "Large object")
                future = self._client.submit(run_piece, *arguments, key=key)
        self._futures[name] = future
        future.add_done_callback(lambda done: self._done.put((name, done)))

    def _take(self, name: str, future: Any) -> None:
        """Stores what a piece has sent, and begins the next one. Pieces that raise are tried again."""
        try:
            written, gone, is_over, shape = future.result()
        except Exception:
            self._failures[name] = self._failures.get(name, 0) + 1
            if self._failures[name] == _MAX_FAILURES:
                raise
            self._submit(name)
            return
        store(self._folder, written, gone)
        self._failures[name] = 0
        del self._futures[name]
        n_left = len(self._futures) + (not is_over)
        self._settings.on_progress(DesignProgress(name, self._progression, shape, is_over, n_left))
        if not is_over:
            self._submit(name)


def run_piece(
    files: Files, name: str, progression: str, seconds: float, threads: int
) -> tuple[Files, list[str], bool, int | None]:
    """The files that a worker writes and removes, whether the design is over, and its newest shape."""
    with tempfile.TemporaryDirectory(prefix="wheelwright-") as scratch:
        folder = Path(scratch)
        store(folder, files, [])
        is_over, shape = _core.run_piece(scratch, _core.plan_in(scratch), name, progression, seconds, threads)
        now = files_of(folder, name)
    written = {path: content for path, content in now.items() if files.get(path) != content}
    return written, [path for path in files if path not in now], is_over, shape


def files_of(folder: Path, name: str) -> Files:
    """A plan with this design only, its case with drawings, and the files of its run."""
    plan = json.loads((folder / _PLAN).read_bytes())
    others = {design["name"] for design in plan["designs"]} - {name}
    plan["designs"] = [design for design in plan["designs"] if design["name"] == name]
    files = {_PLAN: json.dumps(plan).encode()}
    paths = [*folder.glob("*.txt"), *(folder / _DESIGNS).glob("*"), *(folder / _DESIGNS / name).rglob("*")]
    for path in paths:
        where = path.relative_to(folder)
        is_of_other = where.parent == Path(_DESIGNS) and path.name.split(".")[0] in others
        if path.is_file() and path.suffix != ".lock" and not is_of_other:
            files[where.as_posix()] = path.read_bytes()
    return files


def store(folder: Path, written: Files, gone: list[str]) -> None:
    """Writes a piece's files to a folder: what a checkpoint or a result refers to before them."""

    def order(path: str) -> tuple[bool, bool, str]:
        return path.count("/") == 1, "/checkpoints/" in path, path

    for path in sorted(written, key=order):
        if path == _PLAN and (folder / path).exists():
            continue
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        temporary = file.with_name(file.name + ".tmp")
        temporary.write_bytes(written[path])
        os.replace(temporary, file)
    for path in gone:
        (folder / path).unlink(missing_ok=True)
