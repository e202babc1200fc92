"""Solved shapes: contact, fields, strains."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from . import _core
from ._types import FloatArray, IntArray
from .shape import Shape


class RimMotion(NamedTuple):
    """A rigid motion of the rim, in the ground frame."""

    towards_ground: float
    """[m]"""
    along_ground: float
    """Towards larger azimuth [m]."""
    rotation: float
    """About the axle, towards larger azimuth [rad]."""
    along_axle: float
    """In 3D [m]."""


class RimForce(NamedTuple):
    """The forces that do work on the motions of the rim [N/m, N/m, N and N/m in 2D]."""

    towards_ground: float
    along_ground: float
    torque: float
    along_axle: float


class Contact:
    """The contact at one load position: the points of the tread that are near the ground.

    Arrays have one row per point and are views; they keep the state alive.
    """

    def __init__(self, core: _core.Contact) -> None:
        self._core = core

    @property
    def place(self) -> FloatArray:
        """Relative to the axle [m], (point, component), ground frame: towards the ground, along it, across."""
        return self._core.place

    @property
    def gap(self) -> FloatArray:
        """Distance of the undeformed tread to the ground along the ground's normal n [m], (point,)."""
        return self._core.gap

    @property
    def weight(self) -> FloatArray:
        """Length of tread dS that the point stands for [m, or m^2 in 3D], (point,)."""
        return self._core.weight

    @property
    def traction(self) -> FloatArray:
        """The ground's traction on the wheel [Pa], (point, component).

        Component 0 is along the ground's normal n at the point, into the ground, so that the pressure is
        ``-traction[:, 0]``; 1 is along the ground, 2 across.
        """
        return self._core.traction

    @property
    def ground_traction(self) -> FloatArray:
        """The same in the ground frame, which differs where the ground is not flat; a copy."""
        return self._core.ground_traction

    @property
    def pressure(self) -> FloatArray:
        """The contact pressure [Pa], (point,)."""
        pressure: FloatArray = -self._core.traction[:, 0]
        return pressure

    @property
    def column(self) -> IntArray:
        """The column of the ring in which a point lies, (point,)."""
        return self._core.column

    @property
    def rim(self) -> RimMotion:
        """The motion of the rim."""
        return RimMotion(*self._core.rim)

    @property
    def rim_force(self) -> RimForce:
        """The forces on the rim: its load, and the reactions in motions that are not free."""
        return RimForce(*self._core.rim_force)

    @property
    def growth(self) -> float:
        """By how much rotation without load lifts the rim [m]."""
        return self._core.growth

    @property
    def travel(self) -> float:
        """Of the rim towards the ground, from where the rotating wheel without load touches it [m]."""
        return self._core.travel

    @property
    def newton_iterations(self) -> int:
        """Of all attempts to solve the contact."""
        return self._core.newton_iterations


class Material:
    """The law of a material. Strains and results have the components (11, 22, 12) or (11, 22, 33, 23, 13, 12).

    Axis 1 is radial at the first azimuth of the cell, 2 azimuthal there; of an orthotropic material they
    are those of every point. Shear strains are engineering strains. Arguments are arrays (..., component).
    """

    def __init__(self, core: _core.Material) -> None:
        self._core = core

    @staticmethod
    def _rows(strains: FloatArray) -> FloatArray:
        return np.stack([np.ravel(strains[..., k], order="K") for k in range(strains.shape[-1])])

    @staticmethod
    def _like(strains: FloatArray, numbers: FloatArray) -> FloatArray:
        strides = np.empty_like(strains[..., 0]).strides
        return np.lib.stride_tricks.as_strided(numbers, strains.shape[:-1], strides)

    def _tensors(self, strains: FloatArray, rows: FloatArray) -> FloatArray:
        n = strains.shape[-1]
        strides = np.empty_like(strains[..., 0]).strides + (rows.strides[0],)
        return np.lib.stride_tricks.as_strided(rows, strains.shape[:-1] + (n,), strides)

    def stress(self, strains: FloatArray) -> FloatArray:
        """The stress [Pa], (..., component)."""
        return self._tensors(strains, self._core.stress(self._rows(strains)))

    def energy_density(self, strains: FloatArray) -> FloatArray:
        """The strain energy per volume [J/m^3], (...)."""
        return self._like(strains, self._core.energy_density(self._rows(strains)))

    def squared_von_mises(self, strains: FloatArray) -> FloatArray:
        """The square of the von Mises stress [Pa^2], (...); the stress along the axle is part of it."""
        return self._like(strains, self._core.squared_von_mises(self._rows(strains)))

    def squared_von_mises_slope(self, strains: FloatArray) -> FloatArray:
        """Its derivative with respect to the strains, (..., component)."""
        return self._tensors(strains, self._core.squared_von_mises_slope(self._rows(strains)))

    @property
    def modulus(self) -> float:
        """A Young's modulus for small strains [Pa]."""
        return self._core.modulus

    @property
    def lame(self) -> tuple[float, float]:
        """Lame's parameters lambda and mu of an isotropic material [Pa]."""
        lame = self._core.lame
        if lame is None:
            raise ValueError("the material is not isotropic")
        return lame


class Cell:
    """A cell with material, and its strains."""

    def __init__(self, core: _core.Cell) -> None:
        self._core = core

    @property
    def points(self) -> FloatArray:
        """Quadrature points of sector 0 [m], (point, component), Cartesian in the body frame."""
        return self._core.points

    @property
    def weights(self) -> FloatArray:
        """The area that a point stands for [m^2, or m^3 in 3D], (point,)."""
        return self._core.weights

    @property
    def strains(self) -> FloatArray:
        """(position, sector, point, component), with the components of :class:`Material`; a view.

        Those in sector s are those in sector 0 with the ground s sectors back.
        """
        return self._core.strains

    @property
    def material(self) -> Material:
        """The law of the cell's material."""
        return Material(self._core.material)


class State:
    """A solved shape: the wheel under one load at some load positions.

    Position i is solved with the ground turned to its azimuth, in the body frame. Arrays are views that keep
    the state alive, and a state keeps its solver alive.
    """

    def __init__(self, core: _core.State) -> None:
        self._core = core

    @property
    def shape(self) -> Shape:
        """The shape that was solved."""
        return Shape._of(self._core.level_set)

    @property
    def azimuths(self) -> FloatArray:
        """Of the ground at the load positions [rad], (position,)."""
        return self._core.azimuths

    @property
    def multiplicities(self) -> FloatArray:
        """How many load positions of a sector each stands for: 2 with its mirror image, (position,)."""
        return self._core.multiplicities

    @property
    def n_positions(self) -> int:
        """The number of load positions that were solved."""
        return self._core.n_positions

    @property
    def n_sectors(self) -> int:
        """The number of equal sectors of the wheel."""
        return self._core.n_sectors

    @property
    def contacts(self) -> list[Contact]:
        """The contact at every position."""
        return [Contact(contact) for contact in self._core.contacts]

    @property
    def strain_energy(self) -> FloatArray:
        """J_e of every position [J/m, or J in 3D], (position,)."""
        return self._core.strain_energy

    @property
    def observations(self) -> FloatArray:
        """What the tread observes, (position, ring column, row).

        Of the displacement without the rim's motion; a row's meaning is that of :attr:`observation_rows`.
        """
        return self._core.observations

    @property
    def observation_rows(self) -> ObservationRows:
        """The meaning of the rows of :attr:`observations`."""
        n_points, n_annulus_points, has_spin = self._core.observation_rows
        return ObservationRows(n_points, n_annulus_points, has_spin, self._core.tread_weights)

    def displacement(self, position: int) -> FloatArray:
        """Of the nodes [m], (sector, azimuth, [axial,] radial, component), the rim's motion included.

        Cartesian, in the body frame; NaN where a node carries no material.
        """
        return self._core.displacement(position)

    def stress(self, position: int) -> FloatArray:
        """At the nodes [Pa], (sector, azimuth, [axial,] radial, component).

        Components xx, yy, zz, xy, and in 3D yz and xz, in the body frame; NaN without material. At the edge
        of two materials those of the inner one.
        """
        return self._core.stress(position)

    def von_mises(self, position: int) -> FloatArray:
        """The von Mises stress at the nodes [Pa], (sector, azimuth, [axial,] radial)."""
        s = self.stress(position)
        normal = (s[..., 0] - s[..., 1]) ** 2 + (s[..., 1] - s[..., 2]) ** 2 + (s[..., 2] - s[..., 0]) ** 2
        mises: FloatArray = np.sqrt(normal / 2 + 3 * (s[..., 3:] ** 2).sum(axis=-1))
        return mises

    @property
    def largest_von_mises(self) -> FloatArray:
        """The largest von Mises stress of every position, at the quadrature points [Pa], (position,)."""
        return self._core.largest_von_mises

    def pressure_curves(self) -> list[tuple[FloatArray, FloatArray]]:
        """The contact pressure of every load position of a sector, mirror images too, as reports show it.

        For each position the places along the ground [m] and the pressures there [Pa], means over the cells
        at the tread; in 3D in the middle of the width.
        """
        return self._core.pressure_curves()

    def cells(self) -> Iterator[Cell]:
        """The cells of one sector that contain material, with their strains, one after the other."""
        for cell in self._core.cells():
            yield Cell(cell)

    @property
    def seconds(self) -> dict[str, float]:
        """The time that the phases of the solution took [s]."""
        return self._core.phases


class ObservationRows:
    """The rows of the observations of a column of the tread.

    For every contact point the displacement [m] and the traction sigma(u) n [Pa]; then the tractions in the
    annulus, if it is observed; then the integral of u over the column; then, if the wheel rotates, that of
    density u . x. Vectors are Cartesian in the frame of the column, whose first axis is radial at its first
    azimuth.
    """

    def __init__(self, n_points: int, n_annulus_points: int, has_spin: bool, weights: FloatArray) -> None:
        self.n_points = n_points
        """Contact points of a column."""
        self.n_annulus_points = n_annulus_points
        self.has_spin = has_spin
        self.weights = weights
        """Length of tread that a contact point stands for [m, or m^2 in 3D], (point,)."""

    def displacement(self, observations: FloatArray) -> FloatArray:
        """(..., point, component) of observations (..., row), a view."""
        return self._pairs(observations)[..., 0, :]

    def traction(self, observations: FloatArray) -> FloatArray:
        """(..., point, component) of observations (..., row), a view."""
        return self._pairs(observations)[..., 1, :]

    def _pairs(self, observations: FloatArray) -> FloatArray:
        dim = self._dim(observations.shape[-1])
        pairs = observations[..., : 2 * dim * self.n_points]
        return pairs.reshape(pairs.shape[:-1] + (self.n_points, 2, dim))

    def _dim(self, size: int) -> int:
        for dim in (2, 3):
            if size == dim * (2 * self.n_points + self.n_annulus_points + 1) + self.has_spin:
                return dim
        raise ValueError(f"expected the rows of observations, not {size} numbers")


__all__ = ["Cell", "Contact", "Material", "ObservationRows", "RimForce", "RimMotion", "State"]
