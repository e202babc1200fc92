"""The direct problems of the 16-hole wheel by GetFEM: the toolchain of the method's authors.

The same discretization as wheelwright's: polar grid with quadratic cells, quadratic displacement, one cut by a
quadratic level set, ghost penalty (81) on the faces that the boundary crosses, Nitsche contact (28) without
friction, rigid rim that moves vertically under the load (4.3). As fast as GetFEM's Python interface allows:
body frame, so that one mesh, one cut and one bulk matrix serve all load positions; only contact faces near the
ground are assembled in the Newton iteration; MUMPS solves.
"""

import time
from dataclasses import dataclass, field

import getfem as gf
import numpy as np

INNER_RADIUS, OUTER_RADIUS = 0.20, 0.34
HOLES, HOLE_CENTRE, HOLE_RADIUS = 16, 0.27, 0.04
YOUNGS_MODULUS, POISSONS_RATIO = 200e6, 0.48
LOAD = 300 * 9.81 / 0.12
GHOST = 1e-3
THETA = -1.0

TREAD, GHOST_FACES, CONTACT = 1, 2, 3  # mesh regions

LAME = {
    "la": YOUNGS_MODULUS * POISSONS_RATIO / ((1 + POISSONS_RATIO) * (1 - 2 * POISSONS_RATIO)),
    "mu": YOUNGS_MODULUS / (2 * (1 + POISSONS_RATIO)),
}
TRACTION = "(la*Trace(Grad_{0})*Normal + mu*(Grad_{0}+Grad_{0}')*Normal)"
NEIGHBOR_TRACTION = (
    "(la*Trace(Interpolate(Grad_{0},neighbor_element))*Normal"
    " + mu*(Interpolate(Grad_{0},neighbor_element)+Interpolate(Grad_{0},neighbor_element)')*Normal)"
)


@dataclass
class Position:
    strain_energy: float  # J_e (3) [J/m]
    rim_displacement: float  # [m]
    newton_iterations: int


@dataclass
class Result:
    positions: list
    unknowns: int
    seconds: dict = field(default_factory=dict)


class Laps:
    """Wall time by phase; a phase may come back."""

    def __init__(self):
        self.seconds = {}
        self._last = time.perf_counter()

    def lap(self, phase):
        now = time.perf_counter()
        self.seconds[phase] = self.seconds.get(phase, 0) + now - self._last
        self._last = now


def polar_mesh(radial_cells, angular_cells):
    """Quadratic cells; cell = column * radial_cells + row."""
    radius = np.linspace(INNER_RADIUS, OUTER_RADIUS, 2 * radial_cells + 1)
    azimuth = 2 * np.pi / (2 * angular_cells) * np.arange(2 * angular_cells)
    row = 2 * np.arange(radial_cells)[None, :, None, None] + np.arange(3)[None, None, None, :]
    column = 2 * np.arange(angular_cells)[:, None, None, None] + np.arange(3)[None, None, :, None]
    row, column = np.broadcast_arrays(row, column % (2 * angular_cells))
    points = np.stack([radius[row] * np.cos(azimuth[column]), radius[row] * np.sin(azimuth[column])])
    mesh = gf.Mesh("empty", 2)
    mesh.add_convex(gf.GeoTrans("GT_QK(2,2)"), points.reshape(2, -1, 9).transpose(0, 2, 1))
    return mesh


def holes(points):
    """The level set: signed distance of the holes, positive inside them."""
    azimuth = (np.arange(HOLES) + 0.5) * 2 * np.pi / HOLES
    centres = HOLE_CENTRE * np.stack([np.cos(azimuth), np.sin(azimuth)])
    distance = np.linalg.norm(points[:, :, None] - centres[:, None, :], axis=0)
    return HOLE_RADIUS - distance.min(axis=1)


class Wheel:
    """What all load positions share: mesh, cut, spaces, regions, bulk matrix."""

    def __init__(self, radial_cells, angular_cells, laps):
        self.radial_cells, self.angular_cells = radial_cells, angular_cells
        self.mesh = polar_mesh(radial_cells, angular_cells)
        laps.lap("mesh")
        self._cut()
        laps.lap("cut")
        self._spaces()
        laps.lap("spaces")
        self._assemble()
        laps.lap("assembly")

    def _cut(self):
        level_set = gf.LevelSet(self.mesh, 2)
        space = level_set.mf()
        values = holes(space.basic_dof_nodes())
        values[abs(values) < 1e-12] = 1e-12  # no boundary along cell faces
        level_set.set_values(values)
        cut = gf.MeshLevelSet(self.mesh)
        cut.add(level_set)
        cut.adapt()
        self.material = gf.MeshIm("levelset", cut, "inside", gf.Integ("IM_TRIANGLE(6)"))
        self.material.set_integ(gf.Integ("IM_GAUSS_PARALLELEPIPED(2,7)"))
        dofs, _ = space.basic_dof_from_cvid(range(self.mesh.nbcvs()))
        self.cell_values = values[dofs].reshape(-1, 3, 3)  # cell, azimuthal node, radial node
        self._kept = level_set, cut

    def _ghost_faces(self):
        """Cells and their local faces that the boundary crosses, each face once."""
        cell = np.arange(self.mesh.nbcvs())
        not_last_row = cell % self.radial_cells < self.radial_cells - 1
        faces = []
        for local_face, values, exists in (
            (0, self.cell_values[:, :, 2], not_last_row),
            (2, self.cell_values[:, 2, :], np.full(len(cell), True)),
        ):
            crossed = cell[(values.min(axis=1) < 0) & (values.max(axis=1) > 0) & exists]
            faces.append(np.stack([crossed, np.full(len(crossed), local_face)]))
        return np.hstack(faces)

    def _spaces(self):
        mesh = self.mesh
        columns = self.radial_cells * np.arange(self.angular_cells)
        rim = np.stack([columns, np.full(self.angular_cells, 1)])
        tread = np.stack([columns + self.radial_cells - 1, np.zeros(self.angular_cells, int)])
        mesh.set_region(TREAD, tread)
        mesh.set_region(GHOST_FACES, self._ghost_faces())

        everywhere = gf.MeshFem(mesh, 2)
        everywhere.set_fem(gf.Fem("FEM_QK(2,2)"))
        material_cells = np.flatnonzero(self.cell_values.min(axis=(1, 2)) < 0)
        active, _ = everywhere.basic_dof_from_cvid(material_cells)
        fixed = everywhere.basic_dof_on_region(self._region(4, rim))
        kept = np.setdiff1d(active, fixed)
        self.space = gf.MeshFem("partial", everywhere, kept)
        self._tread_dofs = np.searchsorted(kept, everywhere.basic_dof_from_cvid(tread[0])[0]).reshape(-1, 18)

        corners, _ = mesh.pts_from_cvid(range(self.radial_cells))
        corners = corners.reshape(2, -1, 9)[:, :, [0, 2, 6, 8]]
        diagonals = np.linalg.norm(corners[:, :, [0, 1]] - corners[:, :, [3, 2]], axis=0)
        self.diameters = diagonals.max(axis=1)
        self.cellwise = gf.MeshFem(mesh, 1)
        self.cellwise.set_fem(gf.Fem("FEM_QK(2,0)"))
        self.diameter = np.tile(self.diameters, self.angular_cells)
        self.gamma = YOUNGS_MODULUS / self.diameters[-1]

        x, y = everywhere.basic_dof_nodes()[:, kept[::2]]
        radial = np.rint((np.hypot(x, y) - INNER_RADIUS) / (OUTER_RADIUS - INNER_RADIUS) * 2 * self.radial_cells)
        azimuthal = np.rint(np.arctan2(y, x) / np.pi * self.angular_cells) % (2 * self.angular_cells)
        self.node_position = radial.astype(int), azimuthal.astype(int)

        self.faces = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,9)"))  # 5 points a face

    def _region(self, number, faces):
        self.mesh.set_region(number, faces)
        return number

    def _matrix(self, quadrature, expression, region):
        data = [x for name, value in LAME.items() for x in (name, 0, np.array([value]))]
        return gf.asm_generic(
            quadrature, 2, expression, region, "u", 1, self.space, np.zeros(self.space.nbdof()),
            "alpha", 1, np.zeros(1), "h", 0, self.cellwise, self.diameter, *data,
        )

    def _assemble(self):
        """Bulk (2), ghost penalty (81), and the part of (28) that no load position changes."""
        strain_energy = "(la*Trace(Grad_u)*Id(2) + mu*(Grad_u+Grad_u')):Grad_Test_u"
        self.bulk = self._matrix(self.material, strain_energy, -1)
        traction, tested = TRACTION.format("u"), TRACTION.format("Test_u")
        jump = f"({traction} - {NEIGHBOR_TRACTION.format('u')})"
        tested_jump = f"({tested} - {NEIGHBOR_TRACTION.format('Test_u')})"
        ghost = self._matrix(
            self.faces,
            f"{0.25 * GHOST / YOUNGS_MODULUS!r}*(h + Interpolate(h,neighbor_element))*{jump}.{tested_jump}",
            GHOST_FACES,
        )
        nitsche = self._matrix(self.faces, f"{-THETA / self.gamma!r}*{traction}.{tested}", TREAD)
        self.fixed = self.bulk + ghost + nitsche

    def _contact(self, order, ground, u, alpha):
        """Residual (order 1) or tangent (order 2) of the contact term of (28) and of the load balance."""
        traction, tested = TRACTION.format("u"), TRACTION.format("Test_u")
        augmented = f"({traction}.ny - gamma*(u.ny + alpha - ({OUTER_RADIUS} - X.ny)))"
        data = [x for name, value in LAME.items() for x in (name, 0, np.array([value]))]
        return gf.asm_generic(
            self.faces, order,
            f"-neg_part({augmented})*({THETA}/gamma*{tested}.ny - Test_u.ny - Test_alpha)", CONTACT,
            "u", 1, self.space, u, "alpha", 1, alpha, "ny", 0, ground, "gamma", 0, np.array([self.gamma]), *data,
        )

    def turned(self, u, columns):
        """A displacement field turned by some angular cells; zero where it was not defined."""
        radial, azimuthal = self.node_position
        lattice = np.zeros((2 * self.radial_cells + 1, 2 * self.angular_cells, 2))
        lattice[radial, azimuthal] = u.reshape(-1, 2)
        angle = 2 * np.pi / self.angular_cells * columns
        rotation = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        return (np.roll(lattice, 2 * columns, axis=1)[radial, azimuthal] @ rotation.T).ravel()

    def roll_to(self, column, x, laps):
        """Newton from x = (u, alpha), the ground turned to an azimuth given in angular cells, not only whole ones."""
        angle = 2 * np.pi / self.angular_cells
        ground = np.array([np.cos(column * angle), np.sin(column * angle)])
        half = int(np.ceil(4 * HERTZ_HALF_WIDTH / (OUTER_RADIUS * angle))) + 2
        near = np.arange(round(column) - half, round(column) + half + 1) % self.angular_cells
        self.mesh.set_region(
            CONTACT, np.stack([near * self.radial_cells + self.radial_cells - 1, np.zeros(len(near), int)])
        )
        zone = np.append(np.unique(self._tread_dofs[near]), self.space.nbdof())
        fixed = self.fixed.full(zone, zone)
        load = np.zeros_like(x)
        load[-1] = LOAD
        tangent = gf.Spmat("copy", self.fixed)
        for iteration in range(30):
            residual = load - self.fixed * x - self._contact(1, ground, x[:-1], x[-1:])
            if np.linalg.norm(residual) < 1e-10 * LOAD:
                break
            contact = self._contact(2, ground, x[:-1], x[-1:])
            tangent.to_wsc()  # MUMPS leaves the compressed format
            tangent.assign(zone, zone, fixed + contact.full(zone, zone))
            laps.lap("contact assembly")
            x = x + gf.linsolve_mumps(tangent, residual).ravel()
            laps.lap("MUMPS")
        energy = 0.5 * x @ (self.bulk * x)
        laps.lap("contact assembly")
        return x, Position(energy, x[-1], iteration)


HERTZ_HALF_WIDTH = 2 * np.sqrt(LOAD * OUTER_RADIUS * (1 - POISSONS_RATIO**2) / (np.pi * YOUNGS_MODULUS))


def solve(radial_cells, angular_cells, n_positions):
    laps = Laps()
    wheel = Wheel(radial_cells, angular_cells, laps)
    columns = angular_cells / HOLES * np.arange(n_positions) / n_positions
    x = np.zeros(wheel.space.nbdof() + 1)
    x[-1] = HERTZ_HALF_WIDTH**2 / OUTER_RADIUS
    positions = []
    for last, column in zip(np.append(0, columns), columns):
        x[:-1] = wheel.turned(x[:-1], round(column) - round(last))
        x, position = wheel.roll_to(column, x, laps)
        positions.append(position)
    return Result(positions, len(x), laps.seconds)
