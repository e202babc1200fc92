"""Shapes of wheels."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._dimension import level_set, of
from ._types import Array, FloatArray
from .case import Case


class Shape:
    """The shape of a wheel: a level set on the grid of one sector, negative in the material [m].

    ``Shape(case)`` is the initial shape of a case. Shapes pickle.
    """

    def __init__(self, case: Case) -> None:
        self._core: _core.LevelSet = of(case.dimension).initial_shape(case._core)

    @classmethod
    def _of(cls, core: _core.LevelSet) -> Shape:
        shape = cls.__new__(cls)
        shape._core = core
        return shape

    @property
    def values(self) -> FloatArray:
        """The level set at the nodes [m], (azimuth, [axial,] radial), a view."""
        return self._core.values

    @property
    def nodes(self) -> FloatArray:
        """The places of the nodes, (azimuth, [axial,] radial, component).

        Radius [m], azimuth [rad] and, in 3D, the place along the axle [m] of the body.
        """
        return self._core.nodes()

    def with_values(self, values: Array) -> Shape:
        """A shape on the same grid with other values of the level set, (azimuth, [axial,] radial) [m]."""
        return Shape._of(self._core.with_values(np.asarray(values, dtype=float)))

    def moved(self, direction: Array, by: float = 1.0) -> Shape:
        """The shape with ``by`` times ``direction`` added to its level set."""
        return self.with_values(self.values + by * np.asarray(direction, dtype=float))

    @property
    def measure(self) -> float:
        """The area of the material of one sector [m^2], or its volume [m^3] in 3D."""
        return self._core.measure

    @property
    def n_sectors(self) -> int:
        """The number of equal sectors of the wheel."""
        return self._core.n_sectors

    @property
    def radii(self) -> tuple[float, float]:
        """Those of rim and tread [m]."""
        return self._core.radii

    @property
    def resolution(self) -> float:
        """The size of the grid's cells in which motions are measured [m]."""
        return self._core.resolution

    def contours(self) -> list[FloatArray]:
        """The edges of the material of the whole wheel, each a closed line (point, component) [m].

        Cartesian, in the body frame; the material is on the left. In 2D only.
        """
        return self._core.contours()

    def test_direction(self, number: int = 0, step: float | None = None) -> FloatArray:
        """A smooth change of the level set for Taylor tests; ``number`` selects one of several.

        It vanishes at nodes of cells that would be cut otherwise within the step.
        """
        return self._core.test_direction(number, 3 * self._core.test_step if step is None else step)

    @property
    def test_step(self) -> float:
        """The largest step of Taylor tests on this grid [m]."""
        return self._core.test_step

    def save(self, file: str | PathLike[str]) -> None:
        """Writes the shape to a file, exact to the last bit: a ``.levelset`` as in the folders of runs."""
        Path(file).write_bytes(self._core.to_bytes())

    @classmethod
    def load(cls, file: str | PathLike[str]) -> Shape:
        """A shape from such a file."""
        return cls._from_bytes(Path(file).read_bytes())

    @classmethod
    def _from_bytes(cls, data: bytes) -> Shape:
        return cls._of(level_set(data))

    def __getstate__(self) -> bytes:
        return self._core.to_bytes()

    def __setstate__(self, state: bytes) -> None:
        self._core = level_set(state)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Shape):
            return NotImplemented
        return self._core.to_bytes() == other._core.to_bytes()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        grid: Any = "x".join(str(n) for n in self.values.shape)
        return f"<Shape of {grid} nodes, {self.n_sectors} sectors>"
