#!/usr/bin/python3
"""Curved spokes that bow out by GetFEM, against wheelwright.

A soft wheel at held travels of its rim, far beyond the load at which its spokes bow out and its stiffness falls. Both
programs use the discrete form of soft_wheel.py and the level set of wheelwright's initial shape; their ghost
penalties differ. Prints the forces.

Needs python3-getfem (apt-get install python3-getfem) and the Python module of wheelwright (PYTHONPATH).
"""

import argparse

import soft_wheel  # first: it sets the threads of GetFEM

import getfem as gf
import numpy as np
import wheel
import wheelwright as ww

RADIAL_CELLS, ANGULAR_CELLS = 14, 160
KEYS = {
    "material.poissons_ratio": 0.3,
    "contact.gamma_0": float(soft_wheel.GAMMA_0),
    "grid.radial_cells": RADIAL_CELLS,
    "grid.angular_cells": ANGULAR_CELLS,
    "grid.dilatation": "pointwise",
    "optimizer.rim_band": "12.9 mm",
    "optimizer.tread_band": "12.9 mm",
    "shape.spoke[1].thickness": "12 mm",
    "shape.spoke[1].angle": 4.0,
    "shape.spoke[1].bend": 6.0,
}


def level_set(shape, case, cells):
    """The level set of a shape at points of GetFEM's mesh with so many radial and angular cells."""
    values, sectors = shape.values, case["wheel.sectors"]
    radial_step = (case["wheel.outer_radius"] - case["wheel.inner_radius"]) / (2 * cells[0])
    n_azimuths = 2 * cells[1]
    of_sector = n_azimuths // sectors

    def at(points):
        radial = np.rint((np.hypot(*points) - case["wheel.inner_radius"]) / radial_step).astype(int)
        azimuth = np.rint(np.arctan2(points[1], points[0]) / (2 * np.pi) * n_azimuths).astype(int)
        return values[azimuth % n_azimuths % of_sector, radial]

    return at


class Spokes(soft_wheel.SoftWheel):
    """At a held travel of the rim."""

    def forces(self, column, travels):
        """The force on the ground at each travel [N/m], each solved from the two before along a straight line."""
        ground = self.ground_at(column, self.angular_cells // 8)
        x = last = np.zeros(self.space.nbdof() + 1)
        for travel in travels:
            start = x + (x - last) * ((travel - x[-1]) / (x[-1] - last[-1]) if x[-1] > last[-1] else 0.0)
            start[-1] = travel
            last, x = x, self._at_held_travel(start, ground)
            yield -self._residual(x, ground, 0.0)[-1]

    def _at_held_travel(self, x, ground):
        free = np.arange(len(x) - 1)
        for _ in range(60):
            residual = self._residual(x, ground, 0.0)[:-1]
            if np.linalg.norm(residual) < 1e-7 * wheel.LOAD:
                return x
            tangent = gf.Spmat("copy", self.tangent(x, ground), free, free)
            step = gf.linsolve_mumps(tangent, residual).ravel()
            x = x + np.append(step, 0.0)
        raise RuntimeError("Newton's method does not converge")


def by_wheelwright(case, travel):
    """The force over a spoke [N/m]."""
    held = case.replace({"load.mass": None, "load.travel": travel, "load.positions": 1})
    return ww.Study(held).solve().contacts[0].rim_force.towards_ground


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--travels", default="0.001:0.036:36", help="FROM:TO:NUMBER [m]")
    first, last, number = parser.parse_args().travels.split(":")
    travels = np.linspace(float(first), float(last), int(number))
    case = ww.Case.preset("soft-spokes").replace(KEYS)
    wheel.INNER_RADIUS, wheel.OUTER_RADIUS = case["wheel.inner_radius"], case["wheel.outer_radius"]
    wheel.holes = level_set(ww.Study(case).shape, case, (RADIAL_CELLS, ANGULAR_CELLS))
    spokes = Spokes(RADIAL_CELLS, ANGULAR_CELLS, case["material.youngs_modulus"], KEYS["material.poissons_ratio"])
    print("| travel [mm] | force by GetFEM [N/m] | difference of wheelwright |\n|---|---|---|")
    for travel, force in zip(travels, spokes.forces(0, travels)):
        ours = by_wheelwright(case, float(travel))
        print(f"| {1e3 * travel:.3g} | {force:.4f} | {ours / force - 1:.1e} |", flush=True)


if __name__ == "__main__":
    main()
