#!/usr/bin/python3
"""The 16-hole wheel in three dimensions by GetFEM, on a mesh that is fitted to its holes.

An independent solution of the problem that wheelwright solves with cut cells: round holes through the whole width,
free side faces, a rigid rim that moves towards the ground under the load, contact without friction. The mesh has
quadratic hexahedra round every hole, and no level set. Two planes of symmetry, the one of the ground's azimuth and
the middle of the width, leave a quarter of the wheel. Prints the strain energy and the travel of one load position.

Needs python3-getfem++; for example: bench/getfem/wheel3d.py --round 8 --layers 5 --axial 4
"""

import argparse
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import getfem as gf
import numpy as np

INNER_RADIUS, OUTER_RADIUS, WIDTH = 0.20, 0.34, 0.12
HOLES, HOLE_CENTRE, HOLE_RADIUS = 16, 0.27, 0.04
YOUNGS_MODULUS = 200e6
LOAD = 300 * 9.81  # on the whole width [N]

TREAD, CONTACT, RIM, MIRROR, MIDDLE = 2, 3, 4, 5, 6  # mesh regions
TRACTION = "(la*Trace(Grad_{0})*Normal + mu*(Grad_{0}+Grad_{0}')*Normal)"


def graded(n, ratio):
    """2 n + 1 places from 0 to 1, for n quadratic intervals of which each is `ratio` times the one before."""
    sizes = ratio ** np.arange(n) if n > 0 else np.array([])
    ends = np.append(0, np.cumsum(sizes) / sizes.sum())
    middles = (ends[1:] + ends[:-1]) / 2
    return np.sort(np.append(ends, middles))


def sector_layer(n_round, n_layers, tread_ratio):
    """Nodes of a sector's section in polar coordinates: (round the hole, from the hole to the sector's edge)."""
    angle = 2 * np.pi / HOLES
    even = graded(n_round, 1)
    tread = graded(n_round, tread_ratio)  # finer at azimuth 0, where the ground may be
    edges = [
        np.stack([OUTER_RADIUS + 0 * tread, angle * tread], 1),
        np.stack([OUTER_RADIUS - (OUTER_RADIUS - INNER_RADIUS) * graded(n_round, 1.25), angle + 0 * even], 1),
        np.stack([INNER_RADIUS + 0 * even, angle * (1 - even)], 1),
        np.stack([OUTER_RADIUS - (OUTER_RADIUS - INNER_RADIUS) * graded(n_round, 1.25), 0 * even], 1)[::-1],
    ]
    edge = np.concatenate([side[:-1] for side in edges])
    edge = np.append(edge, edge[:1], 0)
    outer = edge[:, :1] * np.stack([np.cos(edge[:, 1]), np.sin(edge[:, 1])], 1)
    centre = HOLE_CENTRE * np.array([np.cos(angle / 2), np.sin(angle / 2)])
    direction = outer - centre
    inner = centre + HOLE_RADIUS * direction / np.linalg.norm(direction, axis=1)[:, None]
    share = graded(n_layers, 1.0)[None, :, None]
    return (1 - share) * inner[:, None, :] + share * outer[:, None, :]


def mesh_of(n_round, n_layers, n_axial, tread_ratio):
    """A quarter of the wheel: half of the sectors, half of the width, in quadratic hexahedra."""
    z = WIDTH / 2 * graded(n_axial, 0.8)  # from the middle to the side face, finer there
    cells = []
    near, far = sector_layer(n_round, n_layers, tread_ratio), sector_layer(n_round, n_layers, 1.0)
    for sector in range(HOLES // 2):
        plane = near if sector == 0 else far
        turn = 2 * np.pi / HOLES * sector
        c, s = np.cos(turn), np.sin(turn)
        plane = plane @ np.array([[c, s], [-s, c]])
        for i in range(4 * n_round):
            for j in range(n_layers):
                for k in range(n_axial):
                    part = plane[2 * i : 2 * i + 3, 2 * j : 2 * j + 3]
                    points = np.zeros((3, 27))
                    for a in range(27):  # the first coordinate of the reference cell varies fastest
                        u, v, w = a % 3, a // 3 % 3, a // 9
                        points[:2, a] = part[v, u]
                        points[2, a] = z[2 * k + w]
                    cells.append(points)
    points = np.array(cells)  # cell, coordinate, node
    # Orientation does not matter to GetFEM; nodes that coincide are merged by it.
    mesh = gf.Mesh("empty", 3)
    mesh.add_convex(gf.GeoTrans("GT_QK(3,2)"), points.transpose(1, 2, 0))
    return mesh


def faces_where(mesh, inside):
    """The outer faces all of whose points satisfy a condition."""
    faces = mesh.outer_faces()
    kept = [
        f for f in range(faces.shape[1]) if inside(mesh.pts_from_cvid(int(faces[0, f]))[0][:, face_nodes(int(faces[1, f]))]).all()
    ]
    return faces[:, kept]


def face_nodes(face):
    """Nodes of a face of GT_QK(3,2): faces 0, 1, 2 at coordinate 1 of the axes, 3, 4, 5 at 0."""
    axis, at = face % 3, 2 if face < 3 else 0
    return [a for a in range(27) if (a % 3, a // 3 % 3, a // 9)[axis] == at]


def solve(n_round, n_layers, n_axial, poissons_ratio, tread_ratio):
    lame = {
        "la": YOUNGS_MODULUS * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio)),
        "mu": YOUNGS_MODULUS / (2 * (1 + poissons_ratio)),
    }
    mesh = mesh_of(n_round, n_layers, n_axial, tread_ratio)
    radius = lambda x: np.hypot(x[0], x[1])
    mesh.set_region(RIM, faces_where(mesh, lambda x: abs(radius(x) - INNER_RADIUS) < 1e-5))
    mesh.set_region(TREAD, faces_where(mesh, lambda x: abs(radius(x) - OUTER_RADIUS) < 1e-5))
    mesh.set_region(CONTACT, faces_where(mesh, lambda x: (abs(radius(x) - OUTER_RADIUS) < 1e-5) & (x[0] > 0) & (abs(x[1]) < 0.05)))
    mesh.set_region(MIRROR, faces_where(mesh, lambda x: abs(x[1]) < 1e-9))
    mesh.set_region(MIDDLE, faces_where(mesh, lambda x: abs(x[2]) < 1e-9))

    everywhere = gf.MeshFem(mesh, 3)
    everywhere.set_fem(gf.Fem("FEM_QK(3,2)"))
    fixed = [everywhere.basic_dof_on_region(RIM)]
    for region, component in ((MIRROR, 1), (MIDDLE, 2)):
        dofs = everywhere.basic_dof_on_region(region)
        fixed.append(dofs[dofs % 3 == component])
    kept = np.setdiff1d(np.arange(everywhere.nbdof()), np.concatenate(fixed))
    space = gf.MeshFem("partial", everywhere, kept)
    bulk_rule = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,6)"))
    face_rule = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,9)"))
    data = [x for name, value in lame.items() for x in (name, 0, np.array([value]))]
    n = space.nbdof()

    def assembled(order, rule, expression, region, u, alpha, *more):
        return gf.asm_generic(rule, order, expression, region, "u", 1, space, u, "alpha", 1, alpha, *data, *more)

    x = np.zeros(n + 1)
    half_width = 2 * np.sqrt(LOAD / WIDTH * OUTER_RADIUS * (1 - poissons_ratio**2) / (np.pi * YOUNGS_MODULUS))
    x[-1] = half_width**2 / OUTER_RADIUS
    bulk = assembled(2, bulk_rule, "(la*Trace(Grad_u)*Id(3) + mu*(Grad_u+Grad_u')):Grad_Test_u", -1, x[:-1], x[-1:])
    gamma = np.array([YOUNGS_MODULUS / 0.005])
    # Nitsche's method with theta = -1, as in (28); the ground's normal is the x axis.
    traction, tested = TRACTION.format("u"), TRACTION.format("Test_u")
    nitsche = assembled(2, face_rule, f"(1/gamma)*{traction}.{tested}", CONTACT, x[:-1], x[-1:], "gamma", 0, gamma)
    linear = gf.Spmat("add", bulk, nitsche)
    augmented = f"({traction}(1) - gamma*(u(1) + alpha - ({OUTER_RADIUS} - X(1))))"
    contact = f"-neg_part({augmented})*(-1/gamma*{tested}(1) - Test_u(1) - Test_alpha)"
    load = np.zeros(n + 1)
    load[-1] = LOAD / 4
    for iteration in range(40):
        residual = load - linear * x - assembled(1, face_rule, contact, CONTACT, x[:-1], x[-1:], "gamma", 0, gamma)
        if np.linalg.norm(residual) < 1e-9 * LOAD:
            break
        tangent = gf.Spmat("add", linear, assembled(2, face_rule, contact, CONTACT, x[:-1], x[-1:], "gamma", 0, gamma))
        x = x + gf.linsolve_mumps(tangent, residual).ravel()
    energy = 4 * 0.5 * x @ (bulk * x)
    return n, iteration, energy, x[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--round", type=int, default=6, help="cells on each of the four sides of a hole")
    parser.add_argument("--layers", type=int, default=4, help="cells from a hole to the edge of its sector")
    parser.add_argument("--axial", type=int, default=3, help="cells in half the width")
    parser.add_argument("--poissons-ratio", type=float, default=0.48)
    parser.add_argument("--tread-ratio", type=float, default=1.5, help="growth of the cells at the tread away from the ground")
    options = parser.parse_args()
    n, iterations, energy, travel = solve(
        options.round, options.layers, options.axial, options.poissons_ratio, options.tread_ratio
    )
    print(f"unknowns {n}, Newton iterations {iterations}, J_e {energy:.6f} J, travel {1e3 * travel:.6f} mm")


if __name__ == "__main__":
    main()
