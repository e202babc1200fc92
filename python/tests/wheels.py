"""Small wheels and own quantities for the tests."""

import numpy as np

import wheelwright as ww

SMALL = """
[wheel]
sectors = 8
[load]
positions = 2
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.03
[grid]
radial_cells = 8
angular_cells = 96
tread_levels = 0
dilatation = "pointwise"
[optimizer]
rim_band = 0.0175
tread_band = 0.035
iterations = 4
tolerance = 0
accepted_increase = 0
minimum_wall = 0
minimum_gap = 0
[output]
checkpoint_every = 1
checkpoint_seconds = 0
errors = "none"
"""



def small(functionals=(), **keys):
    """A wheel that is solved within milliseconds."""
    case = ww.Case.parse(SMALL, functionals)
    return case.replace(keys) if keys else case


def uneven(functionals=()):
    """A wheel without symmetry, with friction, of degree 2."""
    return ww.Case.parse(SMALL, functionals).replace(
        {
            "load.positions": 3,
            "contact.friction": 0.3,
            "holes.ring[1].radius": 0.02,
            "holes.circle[1].radius": 0.011,
            "holes.circle[1].center": [0.252, 0.04],
        }
    )


class PressureSquared(ww.Functional):
    """The integral of p^2 over the contact."""

    name, unit = "pressure_squared", "Pa^2 m"

    def evaluate(self, state):
        values, slopes = [], []
        for c in state.contacts:
            p = -c.traction[:, 0]
            values.append(c.weight @ p**2)
            slope = np.zeros_like(c.traction)
            slope[:, 0] = -2 * c.weight * p
            slopes.append(slope)
        return ww.ByPosition(values, d_traction=slopes)


class Shear(ww.Functional):
    """The torque-like integral of (traction along the ground) * place along it: odd in azimuth."""

    name, unit = "shear", "N"

    def evaluate(self, state):
        values, slopes = [], []
        for c in state.contacts:
            slope = np.zeros_like(c.traction)
            slope[:, 1] = c.weight * (1 + 40 * c.place[:, 1])
            values.append((slope * c.traction).sum())
            slopes.append(slope)
        return ww.ByPosition(values, d_traction=slopes)


class Observed(ww.Functional):
    """A square of what the tread observes, different in all columns."""

    name, unit = "observed", "m^2"

    def evaluate(self, state):
        rows, u = state.observation_rows, state.observations
        weights = np.zeros_like(u)
        columns = 1 + np.cos(np.arange(u.shape[1]))
        rows.displacement(weights)[...] = (columns[:, None] * rows.weights)[..., None]
        return ww.ByPosition((weights * u**2).sum(axis=(1, 2)), d_observations=2 * weights * u)


class RimEnergy(ww.Functional):
    """A product of the rim's travel and the strain energy."""

    name, unit = "rim_energy", "J"

    def evaluate(self, state):
        travel = np.array([c.rim.towards_ground for c in state.contacts])
        d_rim = np.zeros((len(travel), 4))
        d_rim[:, 0] = state.strain_energy
        return ww.ByPosition(travel * state.strain_energy, d_rim=d_rim, d_energy=travel)


class EnergyVariance(ww.TotalFunctional):
    """The variance of the strain energy over the positions."""

    name, unit = "energy_variance", "J^2/m^2"

    def evaluate(self, state):
        energy = state.strain_energy
        m = state.multiplicities / state.multiplicities.sum()
        deviation = energy - m @ energy
        weight = m / state.multiplicities
        return ww.OverPositions(m @ deviation**2, d_energy=2 * weight * deviation)


class FourthPower(ww.MaterialDensity):
    """The fourth power of the von Mises stress."""

    name, unit = "fourth_power", "MPa^4 m^2"

    def values(self, strains, material):
        return material.squared_von_mises(strains) ** 2 / 1e24

    def slopes(self, strains, material):
        square = material.squared_von_mises(strains)
        return 2 / 1e24 * square[..., None] * material.squared_von_mises_slope(strains)


class Edges(ww.EdgeDensity):
    """A moment of the edges of the holes."""

    name, unit = "edges", "m^2"

    def density(self, places):
        values = 1 + places[:, 0] + 0.5 * places[:, 1]
        gradient = np.zeros_like(places)
        gradient[:, 0], gradient[:, 1] = 1, 0.5
        return values, gradient


class AcrossWidth(ww.Functional):
    """Odd across the width: pressure times the place along the axle."""

    name, unit = "across_width", "N m"

    def evaluate(self, state):
        values, slopes = [], []
        for c in state.contacts:
            slope = np.zeros_like(c.traction)
            slope[:, 0] = -c.weight * c.place[:, 2]
            values.append((slope * c.traction).sum())
            slopes.append(slope)
        return ww.ByPosition(values, d_traction=slopes)


ALL = (PressureSquared, Shear, Observed, RimEnergy, EnergyVariance, FourthPower, Edges)
