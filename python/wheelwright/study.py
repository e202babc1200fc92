"""Studies: a case ready to be solved, evaluated and tested."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from os import PathLike
from typing import NamedTuple, Optional

import numpy as np

from . import _core
from ._dimension import of
from ._types import Array, FloatArray
from .case import Case
from .shape import Shape
from .state import State


class Gradient(NamedTuple):
    """A shape gradient: DJ(Theta) = sum of weights * density * (Theta . normals) over the points.

    For a motion Theta of the boundary that is equal in all sectors.
    """

    points: FloatArray
    """Of the moving boundary of sector 0 [m], (point, component), Cartesian in the body frame."""
    normals: FloatArray
    """Outward unit normals of the material, (point, component), in the same frame."""
    weights: FloatArray
    """Length of boundary that a point stands for [m, or m^2 in 3D], (point,)."""
    density: FloatArray
    """[unit of the function per m of motion and per weight], (point,)."""

    def derivative(self, motion: Array) -> float:
        """Along a motion of the points, (point, component) [m]."""
        normal_motion = (np.asarray(motion, dtype=float) * self.normals).sum(axis=1)
        return float((self.weights * self.density) @ normal_motion)


class FunctionValue:
    """A function of the shape at one shape: the objective, a bounded quantity, the volume."""

    def __init__(self, evaluation: _core.Evaluation, name: str) -> None:
        self._evaluation, self.name = evaluation, name
        self.value: float = evaluation.value(name)
        """The value, in 2D per metre of width for forces, energies and masses."""

    @property
    def unit(self) -> str:
        """The unit of the value."""
        return self._evaluation.unit(self.name)

    @property
    def bounds(self) -> tuple[float, float]:
        """Between which the case wants the value."""
        return self._evaluation.bounds(self.name)

    @property
    def by_position(self) -> FloatArray:
        """The share of every load position of a sector, (position,); empty if none has one."""
        return self._evaluation.by_position(self.name)

    @property
    def gradient(self) -> Gradient:
        """The shape gradient at the moving boundary."""
        return Gradient(*self._evaluation.gradient(self.name, False))

    @property
    def edge_gradient(self) -> Gradient:
        """Its part at edges of the moving boundary in the side faces, in 3D under a pressure in the holes."""
        return Gradient(*self._evaluation.gradient(self.name, True))

    @property
    def nodal_gradient(self) -> FloatArray:
        """The derivative with respect to the values of the level set, (azimuth, [axial,] radial) [unit per m].

        The derivative along a change of the level set is the sum of their products.
        """
        return self._evaluation.nodal_gradient(self.name)

    def __float__(self) -> float:
        return self.value

    def __repr__(self) -> str:
        return f"<{self.name} {self.value:.6g} {self.unit}>"


class Evaluation(Mapping[str, FunctionValue]):
    """The functions of a case at one shape, by their names, with their shape gradients.

    ``evaluation["objective"]`` is what the case minimizes. Evaluations pickle, without their states.
    """

    def __init__(self, core: _core.Evaluation) -> None:
        self._core = core

    def __getitem__(self, name: str) -> FunctionValue:
        return FunctionValue(self._core, name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._core.names)

    def __len__(self) -> int:
        return len(self._core.names)

    @property
    def objective(self) -> float:
        """The value that is minimized."""
        return self._core.value("objective")

    @property
    def terms(self) -> dict[str, float]:
        """The functionals of which the functions consist, each summed over the load positions of a sector."""
        return self._core.terms

    @property
    def measures(self) -> dict[str, float]:
        """What history.csv records besides: mean travel, run-out, peak pressure, in SI units."""
        return self._core.measures

    @property
    def shape(self) -> Shape:
        """The shape that was evaluated."""
        return Shape._of(self._core.level_set)

    @property
    def state(self) -> State:
        """The solved shape, under the first load case.

        Of shapes that are their own mirror image it may have only one position of each pair.
        """
        return self.states[0]

    @property
    def states(self) -> list[State]:
        """Under all load cases; none if the evaluation comes from another process."""
        return [State(state) for state in self._core.states]

    @property
    def newton_iterations(self) -> list[int]:
        """Of the contact problem of every position that was solved."""
        return self._core.newton_iterations

    @property
    def seconds(self) -> dict[str, float]:
        """The time that the phases took [s]."""
        return self._core.seconds

    def __getstate__(self) -> tuple[int, tuple[bytes, bytes, int]]:
        return self._core.dimension, self._core.save()

    def __setstate__(self, state: tuple[int, tuple[bytes, bytes, int]]) -> None:
        dimension, saved = state
        self._core = of(dimension).Evaluation.restore(saved)

    def __repr__(self) -> str:
        values = ", ".join(f"{one.name} {one.value:.6g} {one.unit}" for one in self.values())
        return f"<Evaluation: {values}>"


class TaylorTest(NamedTuple):
    """The error of the linear prediction of a function as the step is halved: abs(J(t) - J(0) - t J'(0))."""

    value: float
    derivative: float
    steps: list[float]
    remainders: list[float]
    orders: list[float]
    """log2 of successive remainders' ratios: 2 if the derivative is exact, until rounding."""

    @property
    def order(self) -> float:
        """The lowest order of the remainders that are above rounding; infinite if none are."""
        rounding = 1e-10 * abs(self.value)
        above = [order for order, rest in zip(self.orders, self.remainders[1:]) if rest > rounding]
        return min(above, default=float("inf"))


class GradientCheck(NamedTuple):
    """The Taylor test of one function as ``wheelwright verify`` makes it."""

    function: str
    passed: bool
    is_smoothed: bool
    """Whether the function is a maximum, whose gradient is deliberately that of a smooth approximation."""
    lowest_order: float
    largest_error: float
    test: TaylorTest


class AccurateNumber(NamedTuple):
    """A number of a wheel with the estimate of its discretization error."""

    label: str
    value: float
    """In SI units, on the whole width, in 2D too."""
    error: Optional[float]
    """None: it is not known."""
    reason: str
    """Why it is not as accurate as wanted; empty if it is."""


class Study:
    """A case with its solver. What is independent of the shape is built once, which takes most of its time.

    A study pickles as its case.

    Args:
        case: what to solve.
        level: of the grid: 0 is the case's own, 1 has half of its cells along each axis, and so on.
    """

    def __init__(self, case: Case, level: int = 0) -> None:
        self._case, self._level = case, level
        self._core: _core.Study = of(case.dimension).Study(case._core, level)

    @property
    def case(self) -> Case:
        """The case of the study."""
        return self._case

    @property
    def shape(self) -> Shape:
        """The initial shape of the case, on the study's grid."""
        return Shape._of(self._core.initial)

    @property
    def functions(self) -> list[str]:
        """The names of the functions that are evaluated: the objective, the bounded quantities, the volume."""
        return self._core.functions

    @property
    def load_cases(self) -> list[str]:
        """The names of the load cases; empty: there is one load without a name."""
        return self._core.load_cases

    def evaluate(self, shape: Shape | None = None) -> Evaluation:
        """Values and shape gradients of all functions at a shape, by default the initial one.

        Raises:
            ComputationError: the shape cannot be computed.
        """
        return Evaluation(self._core.evaluate(self._shape(shape)))

    def solve(self, shape: Shape | None = None) -> State:
        """The state of a shape at all load positions, under the first load case."""
        return self.solve_all(shape)[0]

    def solve_all(self, shape: Shape | None = None) -> list[State]:
        """The states under all load cases."""
        return [State(state) for state in self._core.solve(self._shape(shape))]

    def taylor_test(
        self,
        function: str = "objective",
        shape: Shape | None = None,
        direction: Array | None = None,
        step: float | None = None,
        halvings: int = 3,
    ) -> TaylorTest:
        """That of one function of :meth:`taylor_tests`."""
        tests = self.taylor_tests(shape, direction, step, halvings)
        if function not in tests:
            raise KeyError(f"no function is named {function}; there are {', '.join(tests)}")
        return tests[function]

    def taylor_tests(
        self,
        shape: Shape | None = None,
        direction: Array | None = None,
        step: float | None = None,
        halvings: int = 3,
    ) -> dict[str, TaylorTest]:
        """The Taylor tests of all functions' gradients along a change of the level set, by their names.

        By default along a smooth field, from a generic shape beside the given one: at the shape itself edges
        may lie on nodes, and the wheel may be symmetric.
        """
        at = Shape._of(self._shape(shape))
        step = at.test_step if step is None else step
        if direction is None:
            direction = at.test_direction(0, 3 * step)
            at = at.moved(direction, 2 * step)
        along = np.ascontiguousarray(direction, dtype=float)
        tests = self._core.taylor_tests(at._core, along, step, halvings)
        return {function: TaylorTest(*test) for function, test in tests.items()}

    def check_gradients(self, shape: Shape | None = None) -> list[GradientCheck]:
        """The Taylor tests of all functions, as ``wheelwright verify`` makes them.

        Steps within which a point of the tread changes its contact are reduced, and a function that fails is
        tested along other directions.
        """
        checks = self._core.check_gradients(self._shape(shape))
        return [GradientCheck(*check[:-1], TaylorTest(*check[-1])) for check in checks]

    def accurate_numbers(self, accuracy: float = 0.01, shape: Shape | None = None) -> dict[str, AccurateNumber]:
        """The numbers of a shape as ``wheelwright analyze --accuracy`` gives them, by their keys.

        Solved on finer and finer grids until the estimated error of each is at most ``accuracy`` times its
        size, or until the next grid costs too much; ``reason`` then says so.
        """
        numbers = self._core.accurate_numbers(self._shape(shape), accuracy)
        return {number[0]: AccurateNumber(*number[1:]) for number in numbers}

    def export(
        self,
        file: str | PathLike[str],
        shape: Shape | None = None,
        tolerance: float | None = None,
        layer: str | None = None,
    ) -> None:
        """Writes a shape for CAD and the workshop; see :func:`wheelwright.export`."""
        from .results import export

        export(self._case, Shape._of(self._shape(shape)), file, tolerance, layer)

    def _shape(self, shape: Shape | None) -> _core.LevelSet:
        if shape is None:
            return self._core.initial
        if not isinstance(shape, Shape):
            raise TypeError(f"expected a Shape, not {type(shape).__name__}")
        return shape._core

    def __getstate__(self) -> tuple[Case, int]:
        return self._case, self._level

    def __setstate__(self, state: tuple[Case, int]) -> None:
        self.__init__(*state)  # type: ignore[misc]

    def __repr__(self) -> str:
        return f"<Study of {self._case!r}: {', '.join(self.functions)}>"
