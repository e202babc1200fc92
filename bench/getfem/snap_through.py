#!/usr/bin/python3
"""A wheel that snaps through by GetFEM, against wheelwright.

Each of its 8 posts stands on a flat arch and presses it towards the axle: the force on the ground rises to a maximum
and falls while the rim travels on. Both programs solve held travels over a post in the discrete form of soft_wheel.py
with the ghost penalty of kind "full", and with the level set of wheelwright's initial shape. GetFEM starts each travel
from those before, wheelwright from rest. Prints the forces, and the maximum of the parabola through the largest three.

Needs python3-getfem (apt-get install python3-getfem) and the Python module of wheelwright (PYTHONPATH).
"""

import argparse
from pathlib import Path

import curved_spokes  # first: it sets the threads of GetFEM

import numpy as np
import wheel
import wheelwright as ww

CASE = """
title = "Flat arches"
[wheel]
outer_radius = "200 mm"
inner_radius = "120 mm"
width = "80 mm"
sectors = 8
[material]
youngs_modulus = "26 MPa"
poissons_ratio = {ratio!r}
model = "neo_hookean"
[load]
travel = "24 mm"
positions = 1
[contact]
gamma_0 = {gamma_0!r}
[[shape.annulus]]
inner_radius = "148 mm"
[[shape.polygon]]               # room below an arch
count = 8
phase = 0
points = [[0.130, -0.036], [0.149, -0.036], [0.149, 0.036], [0.130, 0.036]]
[[shape.spoke]]                 # the arch; its crown is not in its middle, so that it bows to one side
count = 8
thickness = "7 mm"
inner_radius = "146 mm"
outer_radius = "162 mm"
phase = -18
angle = 20
[[shape.spoke]]
count = 8
thickness = "7 mm"
inner_radius = "146 mm"
outer_radius = "162 mm"
phase = 18
angle = -16
[[shape.spoke]]                 # the post
count = 8
thickness = "14 mm"
inner_radius = "162 mm"
phase = 2
[grid]
radial_cells = {radial_cells}
angular_cells = {angular_cells}
dilatation = "pointwise"
[ghost_penalty]
xi = {xi!r}
[optimizer]
rim_band = "10 mm"
tread_band = "10 mm"
"""


class Arches(curved_spokes.Spokes):
    """With the ghost penalty of kind "full"."""

    GHOST = 1e-4

    def _ghost_faces(self):
        """All faces between cells with material one of which is cut."""
        cell = np.arange(self.mesh.nbcvs())
        active = self.cell_values.min(axis=(1, 2)) < 0
        cut = active & (self.cell_values.max(axis=(1, 2)) > 0)
        not_last_row = cell % self.radial_cells < self.radial_cells - 1
        faces = []
        for local_face, next_cell, exists in (
            (0, np.where(not_last_row, cell + 1, cell), not_last_row),
            (2, (cell + self.radial_cells) % len(cell), True),
        ):
            penalized = cell[exists & active & active[next_cell] & (cut | cut[next_cell])]
            faces.append(np.stack([penalized, np.full(len(penalized), local_face)]))
        return np.hstack(faces)

    def _ghost_form(self):
        """Jumps of the first and the second normal derivative."""
        h = "(0.5*(h + Interpolate(h,neighbor_element)))"
        first = "((Grad_{0} - Interpolate(Grad_{0},neighbor_element))*Normal)"
        second = "((Hess_{0} - Interpolate(Hess_{0},neighbor_element)):(Normal@Normal))"
        first, second = (f"{jump.format('u')}.{jump.format('Test_u')}" for jump in (first, second))
        return f"{0.5 * self.GHOST * self.modulus!r}*({h}*{first} + pow({h},3)*{second})"


def maximum(travels, forces):
    """Place and height of the parabola through the largest force and its neighbours; None if one is missing."""
    i = int(np.argmax(forces))
    if not 0 < i < len(forces) - 1:
        return None
    parabola = np.polyfit(travels[i - 1 : i + 2] - travels[i], forces[i - 1 : i + 2], 2)
    offset = -parabola[1] / (2 * parabola[0])
    return travels[i] + offset, np.polyval(parabola, offset)


def by_getfem(case, cells, travels):
    """The force at each travel [N/m]."""
    wheel.INNER_RADIUS, wheel.OUTER_RADIUS = case["wheel.inner_radius"], case["wheel.outer_radius"]
    wheel.holes = curved_spokes.level_set(ww.Study(case).shape, case, cells)
    arches = Arches(*cells, case["material.youngs_modulus"], case["material.poissons_ratio"])
    return arches.forces(0, travels)


def by_wheelwright(case, travels):
    """The force at each travel [N/m]."""
    for travel in travels:
        held = case.replace({"load.travel": float(travel)})
        yield ww.Study(held).solve().contacts[0].rim_force.towards_ground


def table(travels, forces_of):
    """Prints a row for each travel as soon as its forces are known, and returns them by program."""
    columns = "".join(f" force by {program} [N/m] |" for program in forces_of)
    print(f"| travel [mm] |{columns} difference |\n|---|{'---|' * len(forces_of)}---|")
    rows = []
    for travel, *forces in zip(travels, *forces_of.values()):
        rows.append(forces)
        row = "".join(f" {force:.2f} |" for force in forces)
        print(f"| {1e3 * travel:.3g} |{row} {forces[-1] / forces[0] - 1:.1e} |", flush=True)
    return dict(zip(forces_of, np.transpose(rows)))


def draw(path, travels, forces):
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "snap-through"  # the same file every time
    from matplotlib import pyplot as plt

    _, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    axes.plot(1e3 * travels, forces["wheelwright"] / 1e3, color="#0a5ca8", label="wheelwright")
    axes.plot(1e3 * travels, forces["GetFEM"] / 1e3, "o", color="#b35900", fillstyle="none", label="GetFEM")
    axes.set(xlabel="travel of the rim [mm]", ylabel="force on the ground [kN/m]", xlim=(0, None), ylim=(0, None))
    axes.grid(color="#d8dee4")
    axes.legend()
    plt.savefig(path, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--travels", default="0.002:0.020:10", help="FROM:TO:NUMBER [m]")
    parser.add_argument("--grid", default="16x160", help="radial x angular cells")
    parser.add_argument("--poissons-ratio", type=float, default=0.3)
    parser.add_argument("--without-getfem", action="store_true", help="run only wheelwright, on finer grids")
    parser.add_argument("--write-case", metavar="FILE", help="only write the case, for wheelwright analyze")
    parser.add_argument("--picture", help="SVG of both programs to write; needs python3-matplotlib")
    options = parser.parse_args()
    first, last, number = options.travels.split(":")
    travels = np.linspace(float(first), float(last), int(number))
    cells = [int(n) for n in options.grid.split("x")]
    text = CASE.format(
        ratio=options.poissons_ratio,
        gamma_0=float(curved_spokes.soft_wheel.GAMMA_0),
        xi=Arches.GHOST,
        radial_cells=cells[0],
        angular_cells=cells[1],
    )
    if options.write_case:
        Path(options.write_case).write_text(text)
        return
    case = ww.Case.parse(text)
    forces_of = {"GetFEM": by_getfem(case, cells, travels), "wheelwright": by_wheelwright(case, travels)}
    if options.without_getfem:
        del forces_of["GetFEM"]
    forces = table(travels, forces_of)
    for program, values in forces.items():
        if top := maximum(travels, values):
            fall = 1 - values[-1] / top[1]
            print(f"{program}: at most {top[1]:.2f} N/m at {1e3 * top[0]:.3f} mm; {fall:.1%} less at the last travel")
    if options.picture:
        draw(options.picture, travels, forces)


if __name__ == "__main__":
    main()
