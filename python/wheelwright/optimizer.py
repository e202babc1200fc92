"""The loop from one shape to the next, and its stages."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from . import _core
from ._dimension import of
from ._types import Array, FloatArray
from .shape import Shape
from .study import Evaluation, Study


class Trial(NamedTuple):
    """A trial shape of the loop, accepted or not."""

    iteration: int
    halvings: int
    """Of the step so far, for this iteration."""
    step: float
    """[cells]"""
    verdict: str
    """``accepted``, ``failed`` or ``objective_rose``."""
    failure: str
    detail: str
    objective: float
    """NaN if it was not evaluated."""


class Progress:
    """The loop after an accepted shape: everything that the next one depends on. It pickles."""

    def __init__(self, core: _core.Progress) -> None:
        self._core = core

    @property
    def shape(self) -> Shape:
        """The accepted shape."""
        return Shape._of(self._core.level_set)

    @property
    def evaluation(self) -> Evaluation:
        """Of the shape, without its states."""
        return Evaluation(self._core.evaluation)

    @property
    def iteration(self) -> int:
        """0 for the initial shape."""
        return self._core.iteration

    @property
    def objective(self) -> float:
        """The value that is minimized."""
        return self._core.objectives[-1]

    @property
    def objectives(self) -> list[float]:
        """Of the shapes so far that are compared with each other."""
        return self._core.objectives

    @property
    def step(self) -> float:
        """The step to be tried next [cells]."""
        return self._core.step

    @property
    def measure(self) -> float:
        """The material of one sector [m^2, or m^3 in 3D]."""
        return self._core.measure

    def __getstate__(self) -> tuple[int, bytes, int]:
        return self._core.dimension, *self._core.save()

    def __setstate__(self, state: tuple[int, bytes, int]) -> None:
        dimension, saved, degree = state
        self._core = of(dimension).Progress.restore(saved, degree)

    def __repr__(self) -> str:
        return f"<Shape {self.iteration}: objective {self.objective:.8g}>"


class Optimizer(Iterator[Progress]):
    """The shapes of an optimization, one after the other, the initial one first; no files are written.

    ``for progress in Optimizer(study): ...`` ends when the case's options say so; then :attr:`reason` says
    why. It may be left and continued, also from a :class:`Progress` that was saved.

    Args:
        study: what is optimized.
        start: the first shape, by default the case's, or where to go on.
    """

    def __init__(self, study: Study, start: Shape | Progress | None = None) -> None:
        self._loop = of(study.case.dimension).Loop(study._core)
        self._start = study.shape if start is None else start
        self._last: Progress | None = start if isinstance(start, Progress) else None
        self.reason: str | None = None
        """Why there are no further shapes: ``iterations``, ``converged``, ``no_descent``, ``gave_up``."""
        self.trials: list[Trial] = []
        """Those since the shape before, the newest last."""

    def __next__(self) -> Progress:
        if self._last is None:
            assert isinstance(self._start, Shape)
            progress = Progress(self._loop.start(self._start._core))
        else:
            self.reason = self.reason or self._loop.reason_to_stop(self._last._core)
            if self.reason:
                raise StopIteration
            next_or_reason = self._loop.advance(self._last._core)
            if isinstance(next_or_reason, str):
                self.reason = next_or_reason
                self._take_trials()
                raise StopIteration
            progress = Progress(next_or_reason)
        self._take_trials()
        self._last = progress
        return progress

    def _take_trials(self) -> None:
        self.trials = [
            Trial(t.iteration, t.halvings, t.step, t.verdict, t.failure, t.detail, t.value)
            for t in self._loop.take_trials()
        ]


class Evolver:
    """Moves shapes on the grid of a study, with its case's options: the stages of an own loop."""

    def __init__(self, study: Study) -> None:
        self._core = of(study.case.dimension).Evolver(study._core)

    def velocity(
        self, evaluation: Evaluation, function: str = "objective", preserves_measure: bool = True
    ) -> FloatArray:
        """The descent velocity at the nodes, (azimuth, [axial,] radial), positive where holes recede."""
        return self._core.velocity(evaluation._core, function, preserves_measure)

    def move(self, shape: Shape, velocity: Array, distance: float) -> Shape:
        """The shape moved until the fastest node has travelled ``distance`` [m]."""
        along = np.ascontiguousarray(velocity, dtype=float)
        return Shape._of(self._core.move(shape._core, along, distance))

    def redistance(self, shape: Shape) -> Shape:
        """The same boundary, with a level set that is about a signed distance."""
        return Shape._of(self._core.redistance(shape._core))

    def smooth(self, shape: Shape) -> Shape:
        """The shape smoothed by the case's ``optimizer.smoothing``."""
        return Shape._of(self._core.smooth(shape._core))

    def with_measure(self, shape: Shape, measure: float) -> Shape:
        """The shape shifted to an amount of material in one sector, with the case's minimum widths."""
        return Shape._of(self._core.with_measure(shape._core, measure))
