"""An optimizer of scipy on two parameters of the holes, with the gradients of the library.

usage: scipy_holes.py [ITERATIONS]; with scipy
"""

import sys

import numpy as np
from scipy.optimize import minimize

import wheelwright as ww

iterations = int(sys.argv[1]) if len(sys.argv) > 1 else 15

wheel = ww.Case.preset("paper16").replace(
    {
        "grid.radial_cells": 14,
        "grid.angular_cells": 192,
        "optimizer.rim_band": "1 cm",
        "optimizer.tread_band": "2 cm",
        "holes.ring[1].radius": "30 mm",
    }
)
study = ww.Study(wheel)
volume = study.evaluate()["volume"].value
millimetre = 1e-3


def shape(parameters):
    """The wheel with holes of a radius, on a circle of another one [mm]."""
    center_radius, radius = millimetre * np.asarray(parameters)
    return ww.Shape(
        wheel.replace({"holes.ring[1].center_radius": center_radius, "holes.ring[1].radius": radius})
    )


def function(name):
    """A function of the parameters, and its gradient by the chain rule through the level set."""

    def value_and_gradient(parameters):
        evaluated = study.evaluate(shape(parameters))[name]
        gradient = []
        for step in 1e-3 * np.eye(2):
            change = shape(parameters + step).values - shape(parameters - step).values
            gradient.append((evaluated.nodal_gradient * change).sum() / 2e-3)
        return evaluated.value, np.array(gradient)

    return value_and_gradient


start = np.array([265.0, 30.0])
value, gradient = function("objective")(start)
quotients = [
    (function("objective")(start + step)[0] - function("objective")(start - step)[0]) / 0.2 for step in 0.1 * np.eye(2)
]
print(f"gradient {gradient}, difference quotients {np.array(quotients)}")

amount = {
    "type": "ineq",
    "fun": lambda x: 1e3 * (volume - function("volume")(x)[0]),
    "jac": lambda x: -1e3 * function("volume")(x)[1],
}
found = minimize(
    function("objective"),
    start,
    jac=True,
    method="SLSQP",
    bounds=[(255, 275), (20, 36)],
    constraints=[amount],
    options={"maxiter": iterations},
)
print(f"center radius {found.x[0]:.2f} mm, radius {found.x[1]:.2f} mm: J_e {found.fun:.3f} J/m, from {value:.3f} J/m")
