"""Two own criteria, their Taylor tests, and a run that uses them.

usage: own_criteria.py [SHAPES] [FOLDER]
"""

import sys

import numpy as np

import wheelwright as ww

shapes = int(sys.argv[1]) if len(sys.argv) > 1 else 20
folder = sys.argv[2] if len(sys.argv) > 2 else "runs/own"


class PressureSquared(ww.Functional):
    """The integral of p^2 over the contact: high where the load stands on few points."""

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


class StressPower(ww.MaterialDensity):
    """The integral of the fourth power of the von Mises stress over the material."""

    name, unit = "stress_power", "MPa^4 m^2"

    def values(self, strains, material):
        return 1e-24 * material.squared_von_mises(strains) ** 2

    def slopes(self, strains, material):
        square = material.squared_von_mises(strains)
        return 2e-24 * square[..., None] * material.squared_von_mises_slope(strains)


case = ww.Case.preset("paper16", [PressureSquared(), StressPower()])
case = case.replace(
    {
        "grid.radial_cells": 14,
        "grid.angular_cells": 192,
        "optimizer.rim_band": "1 cm",
        "optimizer.tread_band": "2 cm",
        "optimizer.iterations": shapes,
    }
)

study = ww.Study(case.bound("pressure_squared", at_most=1e15).bound("stress_power", at_most=1e15))
before = study.evaluate()
for check in study.check_gradients():
    print(f"{check.function}: order {check.lowest_order:.2f}, {'passed' if check.passed else 'FAILED'}")

limit = before["pressure_squared"].value
case = case.minimize("stress_power").bound("pressure_squared", at_most=limit)
result = ww.Run(case, folder).execute(on_shape=print)
after = result.progress.evaluation
for name in ("pressure_squared", "objective"):
    print(after[name])
