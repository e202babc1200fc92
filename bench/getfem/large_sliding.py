#!/usr/bin/python3
"""The paper's wheel of rubber on a mesh that fits its holes, in GetFEM's own contact at large sliding.

Nothing is shared with wheelwright but the wheel: GetFEM's brick of finite strain elasticity (Compressible Neo
Hookean Bonet, plane strain) and its contact by raytracing with a rigid obstacle, with a multiplier on the tread.
The rim moves towards the ground until the force is the load. Prints strain energy and travel of a load position
over a spoke and of one over a hole, to compare with those of soft_wheel.py.

Needs python3-getfem (apt-get install python3-getfem).
"""

import argparse
import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_THREAD_LIMIT"] = "1"
sys.dont_write_bytecode = True

import getfem as gf
import numpy as np
from finite_strain import LAW, lame, newton
from wheel import HOLE_CENTRE, HOLE_RADIUS, HOLES, INNER_RADIUS, LOAD, OUTER_RADIUS

RIM, TREAD = 1, 2
WIDTH = 2 * np.pi / HOLES  # of a sector with one hole
SIDES = "outer", "right", "inner", "left"


def on_side(side, s):
    """Points of the outline of the sector whose hole is at azimuth 0, s from 0 to 1 clockwise."""
    radius = {"outer": OUTER_RADIUS, "inner": INNER_RADIUS}.get(side)
    if radius:
        angle = WIDTH * (s - 0.5) * (-1 if side == "outer" else 1)
    else:
        angle = np.full_like(s, -0.5 * WIDTH if side == "right" else 0.5 * WIDTH)
        along = s if side == "left" else 1 - s
        radius = INNER_RADIUS + (OUTER_RADIUS - INNER_RADIUS) * along
    return radius * np.array([np.cos(angle), np.sin(angle)])


def place(side, s, t):
    """From the hole, t = 0, to the sector's outline, t = 1, on straight lines through the hole's centre."""
    outline = on_side(side, s)
    centre = np.array([[HOLE_CENTRE], [0.0]])
    ray = outline - centre
    hole = centre + HOLE_RADIUS * ray / np.hypot(*ray)
    return hole + t * (outline - hole)


def mesh_of(first_hole, layers, cells, cells_in_contact):
    """The hole of sector 0 is at azimuth first_hole; the ground will be at azimuth 0. Quadratic cells."""
    mesh, shape = gf.Mesh("empty", 2), gf.GeoTrans("GT_QK(2,2)")
    faces = {RIM: [], TREAD: []}
    local = np.linspace(0, 1, 3)
    for sector in range(HOLES):
        turn = first_hole + sector * WIDTH
        is_near = abs((turn + np.pi) % (2 * np.pi) - np.pi) < 0.8 * WIDTH
        cosine, sine = np.cos(turn), np.sin(turn)
        for side in SIDES:
            n = cells_in_contact if side == "outer" and is_near else cells
            for i in range(n):
                for k in range(layers):
                    s, t = np.meshgrid((i + local) / n, (k + local) / layers)
                    points = np.array([[cosine, -sine], [sine, cosine]]) @ place(side, s.ravel(), t.ravel())
                    cell = mesh.add_convex(shape, points)[0]
                    if k == layers - 1 and side == "inner":
                        faces[RIM].append((cell, face_at(mesh, cell, INNER_RADIUS)))
                    if k == layers - 1 and side == "outer" and is_near:
                        faces[TREAD].append((cell, face_at(mesh, cell, OUTER_RADIUS)))
    for region, found in faces.items():
        mesh.set_region(region, np.array(found).T)
    return mesh


def face_at(mesh, cell, radius):
    for face in range(4):
        points = mesh.pts(mesh.pid_in_faces(np.array([[cell], [face]])))
        if np.all(np.abs(np.hypot(*points) - radius) < 1e-9):
            return face
    raise RuntimeError("no face on the circle")


class Wheel:
    def __init__(self, mesh, modulus, ratio):
        self.space = gf.MeshFem(mesh, 2)
        self.space.set_fem(gf.Fem("FEM_QK(2,2)"))
        of_contact = gf.MeshFem(mesh, 2)
        of_contact.set_fem(gf.Fem("FEM_QK(2,1)"))
        self.quadrature = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,6)"))
        self.parameters = lame(ratio, modulus)
        model = self.model = gf.Model("real")
        model.add_fem_variable("u", self.space)
        model.add_filtered_fem_variable("contact", of_contact, TREAD)
        model.add_initialized_data("parameters", self.parameters)
        model.add_finite_strain_elasticity_brick(self.quadrature, LAW, "u", "parameters")
        model.add_initialized_data("r", [10 * modulus])
        brick = model.add_integral_large_sliding_contact_brick_raytracing("r", 0.05)
        model.add_rigid_obstacle_to_large_sliding_contact_brick(brick, f"{OUTER_RADIUS}-x", 2)
        model.add_slave_contact_boundary_to_large_sliding_contact_brick(brick, self.quadrature, TREAD, "u", "contact")
        first, n = model.interval_of_variable("u")
        self.of_u = np.arange(first, first + n)
        rim = self.space.basic_dof_on_region(RIM)
        self.rim = first + rim[rim % 2 == 0]
        self.free = np.setdiff1d(np.arange(model.nbdof()), first + rim)
        self.x = np.zeros(model.nbdof())

    def move(self, by):
        """Moves the rim towards the ground and returns its force."""
        step = np.zeros_like(self.x)
        step[self.rim] = by
        self.x = newton(self.model, self.x, step, self.free)
        return float(-np.sum(self.model.rhs()[self.rim]))

    def strain_energy(self):
        return float(gf.asm_generic(
            self.quadrature, 0, f"Plane_Strain_{LAW.replace(' ', '_')}_potential(Grad_u,parameters)", -1,
            "u", 1, self.space, self.x[self.of_u], "parameters", 0, self.parameters,
        ))

    def solve(self, step):
        """Travel and strain energy under the load, by steps of the travel and the secant at its end."""
        travel = before = force = 0.0
        while abs(force - LOAD) > 1e-4 * LOAD:
            by = step if before == force or force < 0.9 * LOAD else (LOAD - force) * last / (force - before)
            before, last = force, min(by, step)
            force = self.move(last)
            travel += last
        return travel, self.strain_energy()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--modulus", type=float, default=16e6)
    parser.add_argument("--poissons-ratio", type=float, default=0.3)
    parser.add_argument("--cells", default="3x6x24", help="layers around holes x on a sector's side x near the contact")
    parser.add_argument("--step", type=float, default=2.5e-4, help="of the travel [m]")
    options = parser.parse_args()
    print("| ground at | unknowns | travel [mm] | strain energy [J/m] |\n|---|---|---|---|")
    for name, first_hole in (("spoke", 0.5 * WIDTH), ("hole", 0.0)):
        mesh = mesh_of(first_hole, *(int(n) for n in options.cells.split("x")))
        wheel = Wheel(mesh, options.modulus, options.poissons_ratio)
        travel, energy = wheel.solve(options.step)
        print(f"| {name} | {len(wheel.free)} | {1e3 * travel:.4f} | {energy:.3f} |", flush=True)


if __name__ == "__main__":
    main()
