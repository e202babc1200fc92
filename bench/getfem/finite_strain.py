#!/usr/bin/python3
"""A bushing and a block of rubber at finite strain by GetFEM: the reference numbers of tests/ring_forms_test.cc.

Plane strain, neo-Hookean by GetFEM's own brick of finite strain elasticity (Compressible Neo Hookean Bonet), on
meshes that fit the body. The bushing: a ring, both circles bonded, the outer one is moved by 30 % of the ring's
thickness. The block: the part of the ring's first quarter between two lines that are parallel to its middle,
bonded to both circles, with free sides; the outer circle is moved towards the inner one by 20 % of the thickness,
and along the block. Prints the stored energy and the force on the outer circle by metre of width, on two meshes
each: their difference is the error of the coarser one.

With names of bodies, only those. Needs python3-getfem (apt-get install python3-getfem).
"""

import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_THREAD_LIMIT"] = "1"
sys.dont_write_bytecode = True

import getfem as gf
import numpy as np

INNER_RADIUS, OUTER_RADIUS = 0.20, 0.34
YOUNGS_MODULUS = 8e6
BLOCK_SIDES = -0.047, 0.061  # distances from the middle [m]
INNER, OUTER = 1, 2
LAW = "Compressible Neo Hookean Bonet"
N_STEPS, TOLERANCE = 10, 1e-8


def lame(ratio, modulus=YOUNGS_MODULUS):
    return np.array([modulus * ratio / ((1 + ratio) * (1 - 2 * ratio)), modulus / (2 * (1 + ratio))])


def bushing(radial, around):
    """The place of a point of the mesh, s around and t outwards, both from 0 to 1."""
    angle, radius = 2 * np.pi * around, INNER_RADIUS + (OUTER_RADIUS - INNER_RADIUS) * radial
    return radius * np.cos(angle), radius * np.sin(angle)


def block(radial, across):
    y = BLOCK_SIDES[0] + (BLOCK_SIDES[1] - BLOCK_SIDES[0]) * across
    inner, outer = np.sqrt(INNER_RADIUS**2 - y**2), np.sqrt(OUTER_RADIUS**2 - y**2)
    return inner + (outer - inner) * radial, y


def even(n):
    return np.linspace(0, 1, n + 1)


def graded(n, power=2):
    """Finer towards both ends, where the stress is singular."""
    half = 0.5 * np.linspace(0, 1, n // 2 + 1) ** power
    return np.concatenate([half, 1 - half[-2::-1]])


def mesh_of(place, radial, across, degree):
    """Cells of the degree, with their nodes on the circles."""
    mesh, shape = gf.Mesh("empty", 2), gf.GeoTrans(f"GT_QK(2,{degree})")
    local = np.linspace(0, 1, degree + 1)
    for t0, t1 in zip(radial, radial[1:]):
        for s0, s1 in zip(across, across[1:]):
            t, s = np.meshgrid(t0 + (t1 - t0) * local, s0 + (s1 - s0) * local)
            cell = mesh.add_convex(shape, np.array(place(t.ravel(), s.ravel())))[0]
            if t0 == 0:
                mark(mesh, INNER, cell, INNER_RADIUS)
            if t1 == 1:
                mark(mesh, OUTER, cell, OUTER_RADIUS)
    return mesh


def mark(mesh, region, cell, radius):
    """Adds the cell's face on a circle to a region."""
    for face in range(4):
        points = mesh.pts(mesh.pid_in_faces(np.array([[cell], [face]])))
        if np.all(np.abs(np.hypot(*points) - radius) < 1e-9):
            present = mesh.region(region) if region in mesh.regions() else np.empty((2, 0), int)
            mesh.set_region(region, np.hstack([present, [[cell], [face]]]))
            return
    raise RuntimeError("no face on the circle")


def solve(mesh, degree, ratio, moved):
    """Stored energy and force on the outer circle, after it has moved, and the number of unknowns."""
    space = gf.MeshFem(mesh, 2)
    space.set_fem(gf.Fem(f"FEM_QK(2,{degree})"))
    quadrature = gf.MeshIm(mesh, gf.Integ(f"IM_GAUSS_PARALLELEPIPED(2,{2 * degree + 4})"))
    model = gf.Model("real")
    model.add_fem_variable("u", space)
    model.add_initialized_data("parameters", lame(ratio))
    model.add_finite_strain_elasticity_brick(quadrature, LAW, "u", "parameters")
    outer, inner = (space.basic_dof_on_region(region) for region in (OUTER, INNER))
    free = np.setdiff1d(np.arange(space.nbdof()), np.concatenate([outer, inner]))
    u = np.zeros(space.nbdof())
    for _ in range(N_STEPS):
        step = np.zeros_like(u)
        step[outer] = np.array(moved)[outer % 2] / N_STEPS
        u = newton(model, u, step, free)
    energy = gf.asm_generic(
        quadrature, 0, f"Plane_Strain_{LAW.replace(' ', '_')}_potential(Grad_u,parameters)", -1,
        "u", 1, space, u, "parameters", 0, lame(ratio),
    )
    forces = -model.rhs()
    return float(energy), [float(sum(forces[outer[outer % 2 == c]])) for c in range(2)], len(free)


def newton(model, u, step, free):
    """The equilibrium after the held unknowns have moved by `step`; the others begin by the tangent's answer."""
    tangent, residual = assembled(model, u)
    for _ in range(40):
        loads = (residual - tangent * step)[free]
        step[free] = gf.linsolve_mumps(gf.Spmat("copy", tangent, free, free), loads).ravel()
        start, part = u, 1.0
        while True:
            u = start + part * step
            tangent, residual = assembled(model, u)
            if np.all(np.isfinite(residual)):
                break
            part /= 2  # material was turned inside out
            if part < 1e-3:
                raise RuntimeError("Newton's method stalls")
        step *= 1 - part
        step[free] = 0
        if not np.any(step) and np.linalg.norm(residual[free]) < TOLERANCE * np.linalg.norm(residual):
            return u
    raise RuntimeError("Newton's method does not converge")


def assembled(model, u):
    """The tangent and the residual; no numbers where material is turned inside out."""
    model.to_variables(u)
    try:
        model.assembly("build_all")
    except RuntimeError:
        return None, np.array([np.nan])
    return model.tangent_matrix(), model.rhs()


CASES = {
    "bushing": (bushing, even, [(3, 36, 4), (4, 48, 4)], {0.3: (-0.042, 0.0), 0.49: (-0.007, 0.0)}),
    "block": (block, graded, [(6, 6, 4), (8, 8, 4)], dict.fromkeys((0.3, 0.49), (-0.028, 0.01))),
}


def main():
    names = sys.argv[1:] or list(CASES)
    print("| body | nu | cells, degree | unknowns | energy [J/m] | force [N/m] | along |\n|---|---|---|---|---|---|---|")
    for name in names:
        place, across, meshes, moved = CASES[name]
        for ratio, motion in moved.items():
            for n_radial, n_across, degree in meshes:
                radial = across(n_radial)
                mesh = mesh_of(place, radial, across(n_across), degree)
                energy, force, unknowns = solve(mesh, degree, ratio, motion)
                print(
                    f"| {name} | {ratio} | {n_radial} x {n_across}, {degree} | {unknowns} | {energy:.4f}"
                    f" | {force[0]:.2f} | {force[1]:.2f} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
