"""Own quantities: criteria that a case can minimize and bound, written in Python."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from . import _core
from ._types import Array, FloatArray

if TYPE_CHECKING:
    from .state import Material, State


class OwnFunctional:
    """The base of own quantities. Derive from :class:`Functional` or one of the densities.

    A quantity is one by its class: instances with equal attributes are equal. Those in cases that are
    pickled, or sent to other processes, must be importable there.
    """

    name: str
    """In case files, histories and evaluations: letters, digits and _."""
    unit: str
    """Shown with its values, such as ``"Pa^2 m"``. In 2D values are those of one metre of width."""
    meaning: str = ""
    """A few words for reports."""
    symmetric_in_azimuth: bool = False
    """Whether its value at a state is that of the state's mirror image in the plane of a load position. Then
    wheels that are their own mirror image are solved in half of their positions only."""
    symmetric_across_width: bool = False
    """The same in the middle plane of the width, in 3D. Then symmetric wheels are solved on half of it."""

    _kind: str
    _over_positions: bool = False

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self.__dict__ == other.__dict__

    __hash__ = object.__hash__


class Derivatives:
    """The derivatives of a functional with respect to the states; see :class:`ByPosition`."""

    d_traction: Optional[list[FloatArray]]
    d_observations: Optional[FloatArray]
    d_rim: Optional[FloatArray]
    d_energy: Optional[FloatArray]
    d_growth: Optional[FloatArray]

    def __init__(
        self,
        d_traction: Sequence[Array] | None,
        d_observations: Array | None,
        d_rim: Array | None,
        d_energy: Array | None,
        d_growth: Array | None,
    ) -> None:
        def array(value: Array | None) -> FloatArray | None:
            return None if value is None else np.ascontiguousarray(value, dtype=float)

        self.d_traction = None
        if d_traction is not None:
            self.d_traction = [np.ascontiguousarray(one, dtype=float) for one in d_traction]
        self.d_observations = array(d_observations)
        self.d_rim = array(d_rim)
        self.d_energy = array(d_energy)
        self.d_growth = array(d_growth)

    def _check(self, name: str, state: State) -> None:
        n = state.n_positions

        def check(what: str, value: FloatArray | None, shape: tuple[int, ...]) -> None:
            if value is not None and value.shape != shape:
                raise ValueError(f"{name}: {what} has the shape {value.shape}; expected {shape}")

        if self.d_traction is not None:
            if len(self.d_traction) != n:
                raise ValueError(f"{name}: d_traction has {len(self.d_traction)} arrays; expected {n}")
            for i, (one, contact) in enumerate(zip(self.d_traction, state.contacts)):
                check(f"d_traction[{i}]", one, contact.traction.shape)
        check("d_observations", self.d_observations, state.observations.shape)
        check("d_rim", self.d_rim, (n, 4))
        check("d_energy", self.d_energy, (n,))
        check("d_growth", self.d_growth, (n,))


class ByPosition(Derivatives):
    """One value per load position, and its derivatives with respect to the state at the same position.

    All derivatives have plus signs: dJ_i = sum of d_traction[i] . d(traction) + ... What is left out is zero.

    Args:
        values: (position,).
        d_traction: with respect to :attr:`Contact.traction`, one array (point, component) per position.
        d_observations: with respect to :attr:`State.observations`, (position, ring column, row).
        d_rim: with respect to the motion of the rim (:class:`RimMotion`), (position, 4).
        d_energy: with respect to :attr:`State.strain_energy`, (position,).
        d_growth: with respect to :attr:`Contact.growth`, (position,).
    """

    values: FloatArray

    def __init__(
        self,
        values: Array,
        *,
        d_traction: Sequence[Array] | None = None,
        d_observations: Array | None = None,
        d_rim: Array | None = None,
        d_energy: Array | None = None,
        d_growth: Array | None = None,
    ) -> None:
        super().__init__(d_traction, d_observations, d_rim, d_energy, d_growth)
        self.values = np.ascontiguousarray(values, dtype=float)


class OverPositions(Derivatives):
    """One value of all load positions together, and its derivatives as those of :class:`ByPosition`.

    Those of a position that stands for its mirror image too (:attr:`State.multiplicities`) are per position
    that it stands for.
    """

    value: float

    def __init__(
        self,
        value: float,
        *,
        d_traction: Sequence[Array] | None = None,
        d_observations: Array | None = None,
        d_rim: Array | None = None,
        d_energy: Array | None = None,
        d_growth: Array | None = None,
    ) -> None:
        super().__init__(d_traction, d_observations, d_rim, d_energy, d_growth)
        self.value = float(value)


class Functional(OwnFunctional):
    """A criterion of the states, by load position.

    A class with ``name``, ``unit`` and :meth:`evaluate`, which returns the values and their derivatives with
    respect to the states; the adjoint problems and the shape gradient follow. The case gets the mean over
    the positions, or what ``over`` of its objective or bound says. For one value of all positions together
    derive from :class:`TotalFunctional`.
    """

    _kind = "states"

    def evaluate(self, state: State) -> ByPosition:
        """The values of a state, one per load position."""
        raise NotImplementedError

    def _evaluate(self, core: _core.State) -> Derivatives:
        from .state import State

        state = State(core)
        result: Any = self.evaluate(state)
        if not isinstance(result, ByPosition):
            raise TypeError(f"{self.name}: evaluate() must return a ByPosition, not {type(result).__name__}")
        if result.values.shape != (state.n_positions,):
            raise ValueError(
                f"{self.name}: values have the shape {result.values.shape}; expected ({state.n_positions},)"
            )
        result._check(self.name, state)
        return result


class TotalFunctional(OwnFunctional):
    """A criterion of all load positions together, such as the variation of a force over them."""

    _kind = "states"
    _over_positions = True

    def evaluate(self, state: State) -> OverPositions:
        """The value of a state."""
        raise NotImplementedError

    def _evaluate(self, core: _core.State) -> Derivatives:
        from .state import State

        state = State(core)
        result: Any = self.evaluate(state)
        if not isinstance(result, OverPositions):
            raise TypeError(f"{self.name}: evaluate() must return an OverPositions, not {type(result).__name__}")
        result._check(self.name, state)
        return result


class MaterialDensity(OwnFunctional):
    """A density that is integrated over the material, by load position.

    It is asked for whole cells. Strains are arrays (position, sector, point, component) with the components of
    :class:`Material`. Values may not depend on the position, sector or point of others.
    """

    _kind = "material"

    def values(self, strains: FloatArray, material: Material) -> Array:
        """The density, (position, sector, point) [unit per m^2, or per m^3 in 3D]."""
        raise NotImplementedError

    def slopes(self, strains: FloatArray, material: Material) -> Array:
        """Its derivative with respect to the strains, (position, sector, point, component)."""
        raise NotImplementedError

    def _values(self, strains: FloatArray, material: _core.Material) -> FloatArray:
        from .state import Material

        return self._checked(self.values(strains, Material(material)), "values()", strains.shape[:-1])

    def _slopes(self, strains: FloatArray, material: _core.Material) -> FloatArray:
        from .state import Material

        return self._checked(self.slopes(strains, Material(material)), "slopes()", strains.shape)

    def _checked(self, result: Array, what: str, shape: tuple[int, ...]) -> FloatArray:
        array = np.asarray(result, dtype=float)
        if array.shape != shape:
            raise ValueError(f"{self.name}: {what} has the shape {array.shape}; expected {shape}")
        return array


class EdgeDensity(OwnFunctional):
    """A density N(x) that is integrated over the edges of the holes of one sector.

    It depends on the place alone, not on the load position; N is the same in all sectors.
    """

    _kind = "edges"

    def density(self, places: FloatArray) -> tuple[Array, Array]:
        """N (point,) and its gradient (point, component) at places (point, component).

        Cartesian, in the body frame [m].
        """
        raise NotImplementedError

    def _densities(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        values, gradients = self.density(places)
        n = np.broadcast_to(np.asarray(values, dtype=float), places.shape[:1])
        gradient = np.broadcast_to(np.asarray(gradients, dtype=float), places.shape)
        return np.ascontiguousarray(n), np.ascontiguousarray(gradient)

