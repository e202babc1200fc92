#!/usr/bin/python3
"""The paper's wheel of rubber at large deformation by GetFEM, against wheelwright.

The same discrete form in GetFEM's language of weak forms, on the same grid with the same cut: a neo-Hookean
material with its tangent derived by GetFEM, Nitsche's contact with Piola tractions (theta = 0, gamma_0 = 20), a
ghost penalty on jumps of the normal derivative at the faces that the boundary crosses (xi = 1e-3), pointwise
ln J. Prints strain energy and travel of a load position over a spoke and of one over a hole.

Needs python3-getfem (apt-get install python3-getfem) and wheelwright, by default that of a Release build.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_THREAD_LIMIT"] = "1"
sys.dont_write_bytecode = True

import getfem as gf
import numpy as np
import wheel

ROOT = Path(__file__).resolve().parents[2]
GAMMA_0 = 20
N_POSITIONS = 2

DEFORMATION = "(Id(2)+Grad_u)"
PIOLA = f"(mu*({DEFORMATION}-Inv({DEFORMATION})') + la*log(Det({DEFORMATION}))*Inv({DEFORMATION})')"
ENERGY = f"(mu/2*(Norm_sqr({DEFORMATION}) - 2 - 2*log(Det({DEFORMATION}))) + la/2*sqr(log(Det({DEFORMATION}))))"

CASE = """
[material]
youngs_modulus = {modulus!r}
poissons_ratio = {ratio!r}
model = "neo_hookean"
[load]
force = 2943
[contact]
gamma_0 = {gamma_0!r}
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
[grid]
radial_cells = {radial_cells}
angular_cells = {angular_cells}
dilatation = "pointwise"
[ghost_penalty]
kind = "paper"
xi = {xi!r}
[optimizer]
rim_band = 0.0101
tread_band = 0.0201
"""


class SoftWheel(wheel.Wheel):
    """The spaces and the cut of the linear wheel, with the forms of large deformation."""

    def __init__(self, radial_cells, angular_cells, modulus, ratio):
        self.modulus = modulus
        lame = {"la": modulus * ratio / ((1 + ratio) * (1 - 2 * ratio)), "mu": modulus / (2 * (1 + ratio))}
        self.data = [x for name, value in lame.items() for x in (name, 0, np.array([value]))]
        super().__init__(radial_cells, angular_cells, wheel.Laps())

    def _assemble(self):
        """The ghost penalty, which does not depend on the displacement."""
        self.ghost = gf.asm_generic(
            self.faces, 2, self._ghost_form(), wheel.GHOST_FACES,
            "u", 1, self.space, np.zeros(self.space.nbdof()), "alpha", 1, np.zeros(1),
            "h", 0, self.cellwise, self.diameter, *self.data,
        )

    def _ghost_form(self):
        jump = "((Grad_{0} - Interpolate(Grad_{0},neighbor_element))*Normal)"
        return (
            f"{0.25 * wheel.GHOST * self.modulus!r}*(h + Interpolate(h,neighbor_element))"
            f"*{jump.format('u')}.{jump.format('Test_u')}"
        )

    def _assembled(self, order, x, ground):
        state = ["u", 1, self.space, x[:-1], "alpha", 1, x[-1:], *self.data]
        bulk = gf.asm_generic(self.material, order, f"{PIOLA}:Grad_Test_u", -1, *state)
        gamma = np.array([GAMMA_0 * self.modulus / self.diameters[-1]])
        augmented = f"(({PIOLA}*Normal).ny - gamma*(u.ny + alpha - ({wheel.OUTER_RADIUS} - X.ny)))"
        contact = gf.asm_generic(
            self.faces, order, f"neg_part({augmented})*(Test_u.ny + Test_alpha)", wheel.CONTACT,
            *state, "ny", 0, ground, "gamma", 0, gamma,
        )
        return bulk, contact

    def _residual(self, x, ground, load):
        bulk, contact = self._assembled(1, x, ground)
        residual = -(self.ghost * x) - bulk - contact
        residual[-1] += load
        return residual

    def strain_energy(self, x):
        return gf.asm_generic(self.material, 0, ENERGY, -1, "u", 1, self.space, x[:-1], *self.data)

    def ground_at(self, column, half):
        """The direction of the ground below a column; contact is sought in so many columns to either side."""
        angle = 2 * np.pi / self.angular_cells
        near = np.arange(round(column) - half, round(column) + half + 1) % self.angular_cells
        tread = np.stack([near * self.radial_cells + self.radial_cells - 1, np.zeros(len(near), int)])
        self.mesh.set_region(wheel.CONTACT, tread)
        return np.array([np.cos(column * angle), np.sin(column * angle)])

    def tangent(self, x, ground):
        bulk, contact = self._assembled(2, x, ground)
        return gf.Spmat("add", gf.Spmat("add", self.ghost, bulk), contact)

    def solve(self, column, n_steps):
        """Newton's method in steps of the load."""
        ground = self.ground_at(column, self.angular_cells // 16)
        x = np.zeros(self.space.nbdof() + 1)
        x[-1] = 1e-4
        for load in wheel.LOAD * np.arange(1, n_steps + 1) / n_steps:
            x = self._newton(x, ground, load)
        return float(self.strain_energy(x)), x[-1]

    def _newton(self, x, ground, load):
        residual = self._residual(x, ground, load)
        for _ in range(60):
            norm = np.linalg.norm(residual)
            if norm < 1e-7 * wheel.LOAD:
                return x
            step = gf.linsolve_mumps(self.tangent(x, ground), residual).ravel()
            share = 1.0
            while True:
                candidate = x + share * step
                residual = self._residual(candidate, ground, load)
                if np.linalg.norm(residual) < 2 * norm or share < 1e-3:  # false for nan: turned inside out
                    break
                share /= 2
            x = candidate
        raise RuntimeError("Newton's method does not converge")


def by_getfem(cells, modulus, ratio, n_steps):
    soft = SoftWheel(*cells, modulus, ratio)
    of_sector = cells[1] // wheel.HOLES
    return [soft.solve(of_sector * i // N_POSITIONS, n_steps) for i in range(N_POSITIONS)]


def by_wheelwright(program, cells, modulus, ratio):
    text = CASE.format(
        modulus=modulus, ratio=ratio, gamma_0=GAMMA_0, radial_cells=cells[0], angular_cells=cells[1], xi=wheel.GHOST
    )
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder) / "case.toml"
        case.write_text(text)
        command = [program, "analyze", case, "--positions", str(N_POSITIONS), "--without-errors", "--json"]
        result = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    return [(p["strain_energy_J_per_m"], p["travel_m"]) for p in json.loads(result)["positions"]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/bin/wheelwright")
    parser.add_argument("--grid", default="14x192", help="radial x angular cells")
    parser.add_argument("--moduli", nargs="+", type=float, default=[32e6, 16e6, 8e6])
    parser.add_argument("--poissons-ratio", type=float, default=0.3)
    parser.add_argument("--steps", type=int, default=4, help="load steps of GetFEM")
    options = parser.parse_args()
    cells = [int(n) for n in options.grid.split("x")]
    print("| E [MPa] | position | J_e GetFEM [J/m] | difference | travel GetFEM [mm] | difference |\n|---|---|---|---|---|---|")
    for modulus in options.moduli:
        ours = by_wheelwright(options.program, cells, modulus, options.poissons_ratio)
        peer = by_getfem(cells, modulus, options.poissons_ratio, options.steps)
        for place, (energy, travel), (our_energy, our_travel) in zip(("spoke", "hole"), peer, ours):
            print(
                f"| {modulus / 1e6:g} | {place} | {energy:.5f} | {our_energy / energy - 1:.1e}"
                f" | {1e3 * travel:.6f} | {our_travel / travel - 1:.1e} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
