"""Runs: an optimization in its folder, with all files that the program writes."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple, Optional

from ._dimension import of
from .case import Case
from .functionals import OwnFunctional
from .optimizer import Progress

Event = dict[str, Any]
"""An event of a run, as docs/driving.md explains them."""


class Finding(NamedTuple):
    """The result of a run for one ``[[expect]]`` of its case."""

    met: bool
    text: str


class RunResult(NamedTuple):
    """How a run ended."""

    reason: str
    """``iterations``, ``converged``, ``no_descent``, ``gave_up``, ``failed_start`` or ``stop_requested``."""
    progress: Optional[Progress]
    """The last accepted shape; None after a failed start."""
    findings: list[Finding]
    folder: Path
    failure: str
    """Why the start failed; empty if it did not."""

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json: the numbers of the wheel before and after."""
        summary: dict[str, Any] = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        return summary


class Run:
    """One optimization in its folder: the same files as those of ``wheelwright run``.

    ``Run(case, folder)`` begins a run; :meth:`resume` goes on with one that was stopped or killed. The folder
    is locked until the run has been executed.

    Raises:
        RunError: the folder is in use, or contains a run or files of others.
    """

    def __init__(self, case: Case, folder: str | PathLike[str] | None = None) -> None:
        where = case._core.folder if folder is None else str(folder)
        self._core = of(case.dimension).Run.begin(case._core, where)

    @classmethod
    def resume(
        cls,
        folder: str | PathLike[str],
        functionals: Iterable[OwnFunctional] = (),
        case: Case | None = None,
    ) -> Run:
        """The run in a folder, from its newest checkpoint.

        Args:
            functionals: the own quantities that its case names.
            case: in place of the case in the folder, for example with more iterations.
        """
        case = Case(folder, functionals) if case is None else case
        run = cls.__new__(cls)
        run._core = of(case.dimension).Run.resume(case._core, str(folder))
        return run

    @property
    def folder(self) -> Path:
        """Where the run writes its files."""
        return Path(self._core.folder)

    @property
    def resumed_after(self) -> int | None:
        """The shape after which a resumed run goes on."""
        return self._core.resumed_after

    def send(self, command: str | Mapping[str, Any]) -> None:
        """Gives the run a command, which it executes between two shapes: from a callback, or another thread.

        A name, ``"stop"``, or all fields, ``{"do": "load", "mass": 60}``; docs/driving.md lists them.
        """
        fields = {"do": command} if isinstance(command, str) else dict(command)
        self._core.send(json.dumps(fields))

    def execute(
        self,
        on_shape: Callable[[Progress], object] | None = None,
        on_event: Callable[[Event], object] | None = None,
    ) -> RunResult:
        """Optimizes until there is a reason to stop. Once only.

        Ctrl-C saves, stops, and raises KeyboardInterrupt; so does what a callback raises.

        Args:
            on_shape: called with every accepted shape.
            on_event: called with every event.
        """
        dimension = of(self._dimension)

        def shape(saved: bytes, degree: int) -> None:
            assert on_shape is not None
            on_shape(Progress(dimension.Progress.restore(saved, degree)))

        def event(line: str) -> None:
            assert on_event is not None
            on_event(json.loads(line))

        reason, saved, degree, findings, failure = self._core.execute(
            None if on_event is None else event, None if on_shape is None else shape
        )
        progress = None if saved is None else Progress(dimension.Progress.restore(saved, degree))
        return RunResult(reason, progress, [Finding(*one) for one in findings], self.folder, failure)

    @property
    def _dimension(self) -> int:
        return self._core.dimension
