"""A wheel without any symmetry through the program, and every file that it writes read back by code of its own.

The holes differ, one lies across a sector face, a torque and a body force in both directions act, and the numbers
of sectors, cells and positions are odd: a sign, an axis or a side that is wrong anywhere between the case and a
file shows. What the files say is compared with the geometry of the case and with the mechanics that they must obey.
usage: no_symmetry_test.py PROGRAM
"""

import bisect
import csv
import functools
import json
import math
import re
import struct
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path
from xml.etree import ElementTree

import support

program = sys.argv.pop(1)
run_program = functools.partial(support.run_program, program)

INNER, OUTER, WIDTH, SECTORS, POSITIONS = 0.2, 0.34, 0.11, 7, 3
SECTOR = 2 * math.pi / SECTORS
YOUNG, POISSON = 60e6, 0.4
FORCE, TORQUE, ALONG, DOWN = 2400.0, 80.0, 3e4, 2e4
# Azimuth [rad] and radius of the centre, and radius of the hole; in every sector.
HOLES = [(math.radians(2), 0.266, 0.024), (math.atan2(0.105, 0.262), math.hypot(0.262, 0.105), 0.028),
         (math.radians(40), 0.249, 0.019)]

CASE = f"""
title = "No symmetry"
[wheel]
inner_radius = {INNER}
outer_radius = {OUTER}
width = {WIDTH}
sectors = {SECTORS}
[material]
youngs_modulus = {YOUNG}
poissons_ratio = {POISSON}
[load]
force = {FORCE}
torque = {TORQUE}
body_force = [{ALONG}, {DOWN}]
positions = {POSITIONS}
[contact]
friction = 0.5
gamma_0 = 10
[[holes.ring]]
count = {SECTORS}
center_radius = 0.266
radius = 0.024
phase = 2
[[holes.ring]]
count = {SECTORS}
center_radius = 0.249
radius = 0.019
phase = 40
[[holes.circle]]
center = [0.262, 0.105]
radius = 0.028
[grid]
radial_cells = 13
angular_cells = 189
tread_levels = 0
[optimizer]
iterations = 0
rim_band = 0.011
tread_band = 0.022
[output]
vtu_every = 1
pictures_every = 1
"""


# --- Geometry, only from the case ----------------------------------------------------------------------


def rotated(x, y, angle):
    c, s = math.cos(angle), math.sin(angle)
    return c * x - s * y, s * x + c * y


def all_holes():
    """(x, y, radius) of every hole of the full wheel, in the body frame."""
    for sector in range(SECTORS):
        for azimuth, distance, radius in HOLES:
            a = azimuth + sector * SECTOR
            yield distance * math.cos(a), distance * math.sin(a), radius


def depth(x, y):
    """How deep in a hole a point is [m]; negative: distance to the nearest hole."""
    return max(radius - math.hypot(x - cx, y - cy) for cx, cy, radius in all_holes())


def is_material(x, y):
    return INNER < math.hypot(x, y) < OUTER and depth(x, y) < 0


MATERIAL_AREA = math.pi * (OUTER**2 - INNER**2) - SECTORS * sum(math.pi * r * r for _, _, r in HOLES)


def probes(margin):
    """Points all over the ring that are at least that far from every boundary, with whether they are material."""
    n_radii, n_azimuths = 13, 151
    for i in range(n_radii):
        radius = INNER + (i + 0.5) / n_radii * (OUTER - INNER)
        for j in range(n_azimuths):
            x, y = rotated(radius, 0, 2 * math.pi * (j + 0.21 + 0.37 * (i % 3)) / n_azimuths)
            if abs(depth(x, y)) > margin and min(radius - INNER, OUTER - radius) > margin:
                yield x, y, is_material(x, y)


def ground_azimuth(position):
    return position * SECTOR / POSITIONS


# --- Readers --------------------------------------------------------------------------------------------


def attribute(tag, name):
    match = re.search(rf'\b{name}="([^"]*)"', tag)
    return match and match[1]


def read_array(data, tag):
    """One array of a VTU file from the bytes behind its XML: a size, then that many bytes."""
    begin = int(attribute(tag, "offset"))
    (size,) = struct.unpack_from("<Q", data, begin)
    code = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B"}[attribute(tag, "type")]
    return struct.unpack_from(f"<{size // struct.calcsize(code)}{code}", data, begin + 8)


class Vtu:
    """Points, cells and fields of a VTU file; vectors as tuples."""

    def __init__(self, path):
        self.fields = {}
        xml, data = path.read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
        for tag in re.findall(r"<DataArray ([^>]*)/>", xml.decode()):
            values = read_array(data, tag)
            n = int(attribute(tag, "NumberOfComponents") or 1)
            if n > 1:
                values = list(zip(*[iter(values)] * n, strict=True))
            self.fields[attribute(tag, "Name")] = values
        self.points = self.fields.pop("Points")
        ends = self.fields.pop("offsets")
        corners = self.fields.pop("connectivity")
        self.cells = [corners[a:b] for a, b in zip((0, *ends[:-1]), ends, strict=True)]

    def centre(self, cell):
        return tuple(sum(self.points[k][d] for k in cell) / len(cell) for d in (0, 1))

    def area(self, cell):
        p = [self.points[k] for k in cell]
        return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(p, p[1:] + p[:1], strict=True))


def subpaths(d):
    """Closed polygons of an SVG path of M, L, l, A and Z; a full circle about the origin as a polygon."""
    tokens = re.findall(r"[A-Za-z]|-?[0-9]+(?:\.[0-9]+)?", d)
    polygons, current, command, radius, k = [], [], "", None, 0
    while k < len(tokens):
        if tokens[k].isalpha():
            command = tokens[k]
            k += 1
            if command in "Zz":
                if radius:
                    current = [rotated(radius, 0, 2 * math.pi * i / 720) for i in range(720)]
                polygons.append(current)
                current, radius = [], None
            continue
        if command in "MLl":
            x, y = float(tokens[k]), float(tokens[k + 1])
            if command == "l":
                x, y = current[-1][0] + x, current[-1][1] + y
            current.append((x, y))
            k += 2
        elif command == "A":
            radius = float(tokens[k])
            k += 7
        else:
            raise ValueError(f"unexpected {command} in a path")
    return polygons


def is_inside(polygons, x, y):
    """Even-odd rule."""
    inside = False
    for polygon in polygons:
        for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1], strict=True):
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                inside = not inside
    return inside


def boxed(polygons):
    """The same test, quicker for many points: polygons with their bounding boxes."""
    boxes = [(min(x for x, _ in p), max(x for x, _ in p), min(y for _, y in p), max(y for _, y in p), p)
             for p in polygons if p]
    return lambda x, y: is_inside([p for a, b, c, d, p in boxes if c <= y <= d and x <= b], x, y)


def read_rows(path):
    with open(path, newline="") as file:
        return [{key: value for key, value in row.items()} for row in csv.DictReader(file)]


def von_mises(gradient):
    """From a displacement's gradient, in plane strain."""
    (xx, a), (b, yy) = gradient
    xy, mean = 0.5 * (a + b), (xx + yy) / 3
    square = (xx - mean) ** 2 + (yy - mean) ** 2 + mean**2 + 2 * xy**2
    return YOUNG / (1 + POISSON) * math.sqrt(1.5 * square)


def mean_gradient(points, displacements):
    """Of a displacement over a polygon, by the divergence theorem on its straight sides."""
    area, sums = 0.0, [[0.0, 0.0], [0.0, 0.0]]
    n = len(points)
    for k in range(n):
        p, q, u, v = points[k], points[(k + 1) % n], displacements[k], displacements[(k + 1) % n]
        area += 0.5 * (p[0] * q[1] - p[1] * q[0])
        normal = (q[1] - p[1], p[0] - q[0])
        for i in (0, 1):
            for j in (0, 1):
                sums[i][j] += 0.5 * (u[i] + v[i]) * normal[j]
    return [[value / area for value in row] for row in sums]


# --- Tests ----------------------------------------------------------------------------------------------


class NoSymmetry(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        folder = Path(cls.temporary.name)
        cls.case = folder / "case.toml"
        cls.case.write_text(CASE)
        cls.run_folder = folder / "run"
        run_program("run", cls.case, "--output", cls.run_folder)
        cls.analysis = json.loads(run_program("analyze", cls.case, "--positions", POSITIONS, "--json",
                                              "--output", folder / "analysis"))
        cls.analysis_folder = folder / "analysis"
        cls.positions = [Vtu(cls.run_folder / f"rolling/wheel_{i:02d}.vtu") for i in range(POSITIONS)]
        cls.history = read_rows(cls.run_folder / "history.csv")
        peaks = [p["peak_von_mises_Pa"] for p in cls.analysis["positions"]]
        cls.worst = peaks.index(max(peaks))
        cls.tread_displacement = []

    def assertClose(self, found, expected, tolerance, message=None):
        self.assertLessEqual(abs(found - expected), tolerance, f"{found} is not {expected}: {message}")

    # The geometry

    def test_the_level_set_is_the_distance_to_the_holes(self):
        vtu = Vtu(self.run_folder / "shapes/shape_0000.vtu")
        self.assertGreater(len(vtu.points), 5000)
        for (x, y, z), psi in zip(vtu.points, vtu.fields["psi_m"], strict=True):
            self.assertEqual(z, 0)
            if depth(x, y) > -0.006:  # farther away the nearest hole may change between the nodes
                self.assertClose(psi, depth(x, y), 1e-4, (x, y))

    def test_cells_cover_the_material_and_nothing_else(self):
        for vtu in self.positions:
            self.assertClose(sum(abs(vtu.area(cell)) for cell in vtu.cells) / MATERIAL_AREA, 1, 1e-3)
            for cell in vtu.cells:
                x, y = vtu.centre(cell)
                self.assertLess(depth(x, y), 1e-4)
                self.assertTrue(INNER < math.hypot(x, y) < OUTER)

    def test_the_shape_for_cutting_shows_the_material_with_y_down(self):
        svg = (self.run_folder / "shape.svg").read_text()
        inside = boxed(subpaths(attribute(re.search(r"<path[^>]*>", svg)[0], "d")))
        for x, y, material in probes(5e-4):
            self.assertEqual(inside(1000 * x, -1000 * y), material, (x, y))

    def test_both_wheels_of_the_comparison_show_the_material(self):
        svg = (self.run_folder / "comparison.svg").read_text()
        groups = re.findall(r'<g transform="translate\(([0-9.]+) ([0-9.]+)\) scale\(([0-9.]+)\)">(.*?)</g>', svg,
                            re.DOTALL)
        self.assertEqual(len(groups), 2)
        for *_, content in groups:
            inside = boxed(subpaths(attribute(re.search(r'<path class="material"[^>]*>', content)[0], "d")))
            for x, y, material in probes(3e-3):
                self.assertEqual(inside(2000 / OUTER * x, -2000 / OUTER * y), material, (x, y))
        former = boxed(subpaths(attribute(re.search(r'<path class="former"[^>]*>', groups[1][3])[0], "d")))
        for x, y, material in probes(3e-3):
            self.assertEqual(former(2000 / OUTER * x, -2000 / OUTER * y), not material, (x, y))

    def test_the_picture_of_the_grid_shows_the_material_in_every_sector(self):
        svg = (self.run_folder / "mesh.svg").read_text()
        layers = [boxed(subpaths(attribute(re.search(rf'<path fill="{colour}"[^>]*>', svg)[0], "d")))
                  for colour in ("#9ec1e3", "#e8833a")]
        turns = [0.0] + [math.radians(float(t)) for t in re.findall(r"rotate\((-?[0-9.]+)\)", svg)]
        self.assertEqual(len(turns), SECTORS)
        for x, y, material in probes(2e-3):
            px, py = 7200 / OUTER * x, -7200 / OUTER * y
            shown = any(layer(*rotated(px, py, -turn)) for turn in turns for layer in layers)
            self.assertEqual(shown, material, (x, y))

    def test_the_volume_fraction_is_that_of_the_circles(self):
        fraction = MATERIAL_AREA / (math.pi * (OUTER**2 - INNER**2))
        self.assertClose(float(self.history[0]["volume fraction [-]"]), fraction, 2e-4)

    # The case

    def test_the_case_in_the_folder_is_the_case(self):
        def expect_part(given, written, place):
            for key, value in given.items():
                if isinstance(value, dict):
                    expect_part(value, written[key], f"{place}.{key}")
                elif isinstance(value, list) and isinstance(value[0], dict):
                    for g, w in zip(value, written[key], strict=True):
                        expect_part(g, w, f"{place}.{key}")
                elif isinstance(value, list):
                    for g, w in zip(value, written[key], strict=True):
                        self.assertClose(w, g, 1e-12 * abs(g), f"{place}.{key}")
                elif isinstance(value, float):
                    self.assertClose(written[key], value, 1e-12 * abs(value), f"{place}.{key}")
                else:
                    self.assertEqual(written[key], value, f"{place}.{key}")

        written = self.run_folder / "case.toml"
        expect_part(tomllib.loads(CASE), tomllib.loads(written.read_text()), "")
        again = json.loads(run_program("analyze", written, "--positions", POSITIONS, "--json"))
        self.assertEqual(again, self.analysis)

    # The mechanics

    def rim(self, vtu, position):
        """The rim's motion towards the ground and along it, and its rotation: means over the rim's points."""
        ground = ground_azimuth(position)
        towards = along = rotation = 0.0
        nodes = {(round(x, 6), round(y, 6)): u for (x, y, _), u in
                 zip(vtu.points, vtu.fields["displacement_m"], strict=True) if math.hypot(x, y) < INNER + 1e-6}
        self.assertGreaterEqual(len(nodes), 2 * 189)
        for (x, y), u in nodes.items():
            n, t = rotated(u[0], u[1], -ground)
            towards, along = towards + n, along + t
            rotation += (x * u[1] - y * u[0]) / (x * x + y * y)
        return towards / len(nodes), along / len(nodes), rotation / len(nodes)

    def rims_under(self, load):
        """Of all positions, with another load than the torque."""
        name = "".join(filter(str.isalnum, load))
        case, folder = (Path(self.temporary.name) / f"{name}{end}" for end in (".toml", ""))
        case.write_text(CASE.replace(f"torque = {TORQUE}", load))
        run_program("run", case, "--output", folder)
        return [self.rim(Vtu(folder / f"rolling/wheel_{i:02d}.vtu"), i) for i in range(POSITIONS)]

    def test_the_rim_travels_towards_the_ground_and_turns_with_the_torque(self):
        for i, less in enumerate(self.rims_under(f"torque = {0.5 * TORQUE}")):
            towards, along, rotation = self.rim(self.positions[i], i)
            travel = self.analysis["positions"][i]["travel_m"]
            self.assertClose(towards, travel, 1e-5 * travel)
            self.assertClose(along, 0, 1e-5 * travel)
            self.assertGreater((rotation - less[2]) * OUTER, 0.05 * travel)

    def test_the_rim_follows_a_force_along_the_ground(self):
        more, less = self.rims_under("horizontal_force = 100"), self.rims_under("horizontal_force = 40")
        for (towards, along, rotation), (_, along_less, _) in zip(more, less, strict=True):
            self.assertClose(rotation * OUTER, 0, 1e-5 * towards)
            self.assertGreater(along - along_less, 0.01 * towards)

    def test_history_and_analysis_tell_the_same(self):
        row, positions = self.history[0], self.analysis["positions"]
        travels = [p["travel_m"] for p in positions]
        peaks = [p["peak_pressure_Pa"] for p in positions]
        for column, value in (("mean_travel [m]", sum(travels) / POSITIONS),
                              ("run_out [m]", max(travels) - min(travels)),
                              ("peak_pressure [Pa]", max(peaks)),
                              ("pressure_spread [-]", (max(peaks) - min(peaks)) * POSITIONS / sum(peaks)),
                              ("strain_energy [J/m]", sum(p["strain_energy_J_per_m"] for p in positions))):
            self.assertClose(float(row[column]), value, 1e-9 * abs(value), column)
        self.assertEqual(row["objective [J/m]"], row["strain_energy [J/m]"])
        for i, position in enumerate(positions):
            self.assertClose(position["azimuth_rad"], ground_azimuth(i), 1e-12)

    def test_the_ground_carries_load_and_weight(self):
        expected = FORCE + DOWN * MATERIAL_AREA * WIDTH
        for position in self.analysis["positions"]:
            self.assertClose(position["radial_force_N"], expected, 1e-3 * expected)
            self.assertClose(position["stiffness_N_per_m"], position["radial_force_N"] / position["travel_m"],
                             1e-9 * position["stiffness_N_per_m"])

    def test_the_body_force_pushes_along_the_ground(self):
        # Above the axle the contact does next to nothing: what the material does against the rim is the body
        # force's work, towards larger azimuth at the ground, which is one Cartesian direction everywhere.
        for i, vtu in enumerate(self.positions):
            ground = ground_azimuth(i)
            towards, along, rotation = self.rim(vtu, i)
            mean = n = 0
            for (x, y, _), u in zip(vtu.points, vtu.fields["displacement_m"], strict=True):
                px, py = rotated(x, y, -ground)
                if px < -0.5 * OUTER:
                    mean += rotated(u[0], u[1], -ground)[1] - along - rotation * px
                    n += 1
            self.assertGreater(n, 500)
            self.assertGreater(mean / n, 1e-2 * towards)

    def test_the_deformed_tread_lies_on_the_ground_at_its_azimuth(self):
        for i, vtu in enumerate(self.positions):
            ground = ground_azimuth(i)
            travel = self.analysis["positions"][i]["travel_m"]
            lowest = max(((x + u[0]) * math.cos(ground) + (y + u[1]) * math.sin(ground), math.atan2(y, x) - ground)
                         for (x, y, _), u in zip(vtu.points, vtu.fields["displacement_m"], strict=True))
            self.assertClose(lowest[0], OUTER, 0.1 * travel)
            self.assertLess(abs(math.remainder(lowest[1], 2 * math.pi)), 0.08)

    def rows_of(self, file, position):
        return [{key: float(value) for key, value in row.items()} for row in read_rows(file)
                if row["position"] == str(position)]

    def test_gaps_are_those_of_the_displacement_at_the_points_azimuth(self):
        for i, vtu in enumerate(self.positions):
            ground, travel = ground_azimuth(i), self.analysis["positions"][i]["travel_m"]
            tread = sorted({(round(math.remainder(math.atan2(y, x) - ground, 2 * math.pi), 7),
                             round(OUTER - (x + u[0]) * math.cos(ground) - (y + u[1]) * math.sin(ground), 9))
                            for (x, y, _), u in zip(vtu.points, vtu.fields["displacement_m"], strict=True)
                            if math.hypot(x, y) > OUTER - 1e-6})
            rows = self.rows_of(self.run_folder / "pressures_final.csv", i)
            self.assertGreater(len(rows), 20)
            compared = 0
            for row in rows:
                azimuth = math.radians(row["azimuth [deg]"])
                self.assertClose(row["x [m]"], OUTER * math.sin(azimuth), 1e-4 * OUTER)
                for (a, gap_a), (b, gap_b) in zip(tread, tread[1:], strict=False):
                    if a <= azimuth < b:
                        gap = gap_a + (azimuth - a) / (b - a) * (gap_b - gap_a)
                        chord = 0.5 * OUTER * (azimuth - a) * (b - azimuth)
                        self.assertClose(row["gap [m]"], gap - chord, 0.04 * travel, math.degrees(azimuth))
                        compared += 1
            self.assertGreater(compared, 0.9 * len(rows))

    def test_pressures_are_those_of_the_analysis(self):
        for file in (self.run_folder / "pressures_initial.csv", self.run_folder / "pressures_final.csv",
                     self.analysis_folder / "pressures.csv"):
            for i, position in enumerate(self.analysis["positions"]):
                rows = self.rows_of(file, i)
                self.assertClose(max(r["pressure [Pa]"] for r in rows), position["peak_pressure_Pa"],
                                 1e-9 * position["peak_pressure_Pa"])
                touching = [r for r in rows if r["pressure [Pa]"] > 0]
                self.assertLess(touching[-1]["x [m]"] - touching[0]["x [m]"], position["patch_length_m"])
                for name, force in (("pressure [Pa]", "radial_force_N"), ("friction [Pa]", "friction_force_N")):
                    self.assertClose(sum(r["weight [m]"] * r[name] for r in rows) * WIDTH, position[force],
                                     1e-9 * position["radial_force_N"])
                self.assertClose(max(abs(r["friction [Pa]"]) for r in rows), position["peak_friction_Pa"],
                                 1e-9 * position["peak_pressure_Pa"])
                for row in touching:
                    self.assertLess(row["gap [m]"], 1e-2 * position["travel_m"])

    def test_pressures_integrate_to_the_load_without_friction_too(self):
        case, folder = (Path(self.temporary.name) / f"frictionless{end}" for end in (".toml", ""))
        case.write_text(CASE.replace(f"torque = {TORQUE}", "").replace("friction = 0.5", ""))
        positions = json.loads(run_program("analyze", case, "--positions", 5, "--json", "--output", folder))["positions"]
        expected = FORCE + DOWN * MATERIAL_AREA * WIDTH
        for i, position in enumerate(positions):
            rows = self.rows_of(folder / "pressures.csv", i)
            force = sum(r["weight [m]"] * r["pressure [Pa]"] for r in rows) * WIDTH
            self.assertClose(force, position["radial_force_N"], 1e-9 * expected)
            self.assertClose(force, expected, 1e-3 * expected)
            self.assertEqual({r["friction [Pa]"] for r in rows}, {0.0})
            self.assertEqual((position["friction_force_N"], position["wind_up_rad"]), (0, 0))

    # The tread and the ground

    def tread(self, position):
        return Vtu(self.run_folder / f"rolling/tread_{position:02d}.vtu")

    def test_the_tractions_on_the_tread_are_in_equilibrium_with_load_and_torque(self):
        for i, position in enumerate(self.analysis["positions"]):
            tread, ground = self.tread(i), ground_azimuth(i)
            towards = along = moment = turning = 0.0
            for (x, y, _), t, p, f, w in zip(tread.points, *(tread.fields[name] for name in (
                    "traction_Pa", "pressure_Pa", "friction_Pa", "weight_m")), strict=True):
                n, s = rotated(t[0], t[1], -ground)
                self.assertClose(n, -p, 1e-5 * position["peak_pressure_Pa"])
                self.assertClose(s, f, 1e-5 * position["peak_pressure_Pa"])
                self.assertLessEqual(abs(f), 0.5 * p * (1 + 1e-3) + 1e-3 * position["peak_pressure_Pa"])
                towards, along = towards + w * n * WIDTH, along + w * s * WIDTH
                moment += w * (x * t[1] - y * t[0]) * WIDTH
                turning += w * abs(x * t[1] - y * t[0]) * WIDTH
            self.assertClose(towards, -FORCE - DOWN * MATERIAL_AREA * WIDTH, 1e-4 * FORCE)
            self.assertClose(along, position["friction_force_N"], 1e-5 * FORCE)
            # The rim's torque and the ground's tractions turn the wheel in opposite senses.
            self.assertClose(moment, -TORQUE, 1e-5 * turning)
            self.assertLess(along, -0.5 * TORQUE / OUTER)

    def test_the_tread_moves_with_the_wheel_and_has_the_gaps_of_its_displacement(self):
        for i, vtu in enumerate(self.positions):
            tread, ground = self.tread(i), ground_azimuth(i)
            travel = self.analysis["positions"][i]["travel_m"]
            edge = {round(math.atan2(y, x), 6): u for (x, y, _), u in
                    zip(vtu.points, vtu.fields["displacement_m"], strict=True) if math.hypot(x, y) > OUTER - 1e-6}
            azimuths = sorted(edge)
            compared = 0
            for (x, y, _), u, gap in zip(tread.points, tread.fields["displacement_m"], tread.fields["gap_m"],
                                         strict=True):
                n, _ = rotated(x + u[0], y + u[1], -ground)
                self.assertClose(gap, OUTER - n, 1e-7)
                k = bisect.bisect(azimuths, math.atan2(y, x))
                if 0 < k < len(azimuths):
                    a, b = azimuths[k - 1], azimuths[k]
                    share = (math.atan2(y, x) - a) / (b - a)
                    for d in (0, 1):
                        self.assertClose(u[d], (1 - share) * edge[a][d] + share * edge[b][d], 0.03 * travel)
                    compared += 1
            self.assertGreater(compared, 0.9 * len(tread.points))

    def test_the_ground_stands_where_the_tread_touches_it(self):
        for i in range(POSITIONS):
            ground = Vtu(self.run_folder / f"rolling/ground_{i:02d}.vtu")
            corners = [rotated(x, y, -ground_azimuth(i)) for x, y, _ in ground.points]
            self.assertClose(min(n for n, _ in corners), OUTER, 1e-6)
            self.assertGreater(max(n for n, _ in corners), 1.01 * OUTER)
            self.assertClose(sum(t for _, t in corners), 0, 1e-6)

    def test_times_of_the_collection_are_azimuths_of_the_contact(self):
        collection = ElementTree.parse(self.run_folder / "rolling.pvd").getroot()
        found = [(float(e.get("timestep")), e.get("name"), e.get("part"), e.get("file"))
                 for e in collection.iter("DataSet")]
        expected = [(math.degrees(ground_azimuth(i)), name, str(part), f"rolling/{name}_{i:02d}.vtu")
                    for i in range(POSITIONS) for part, name in enumerate(("wheel", "tread", "ground"))]
        self.assertEqual([entry[1:] for entry in found], [entry[1:] for entry in expected])
        for (time, *_), (degrees, *_) in zip(found, expected, strict=True):
            self.assertClose(time, degrees, 1e-9)

    def test_the_rim_winds_up_as_the_analysis_says(self):
        for i, position in enumerate(self.analysis["positions"]):
            _, along, rotation = self.rim(self.positions[i], i)
            self.assertClose(rotation, position["wind_up_rad"], 1e-5 * abs(rotation))
            self.assertClose(along, position["travel_along_ground_m"], 1e-5 * position["travel_m"])

    # Stress and the shape gradient

    def test_the_von_mises_stress_is_that_of_the_tensor(self):
        for vtu in (*self.positions, Vtu(self.run_folder / "shapes/shape_0000.vtu")):
            for (xx, yy, zz, xy, yz, xz), stress in zip(vtu.fields["stress_Pa"], vtu.fields["von_mises_Pa"], strict=True):
                self.assertGreaterEqual(stress, 0)
                self.assertEqual((yz, xz), (0, 0))
                square = 0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * xy**2
                self.assertClose(stress, math.sqrt(square), 1e-5 * stress + 1)
                self.assertClose(zz, POISSON * (xx + yy), 1e-5 * stress + 1)

    def test_the_stress_balances_the_tractions_on_the_tread_and_the_body_force(self):
        # Virtual work of a motion that carries the tread towards the ground or along it and leaves the rim.
        share = lambda x, y: (math.hypot(x, y) - INNER) / (OUTER - INNER)
        for i, vtu in enumerate(self.positions):
            ground = ground_azimuth(i)
            tread = self.tread(i)
            for direction, force in ((rotated(1, 0, ground), DOWN), (rotated(0, 1, ground), ALONG)):
                inner = outer = 0.0
                for cell in vtu.cells:
                    x, y = vtu.centre(cell)
                    area, radius = abs(vtu.area(cell)), math.hypot(x, y)
                    xx, yy, _, xy, *_ = (sum(vtu.fields["stress_Pa"][k][c] for k in cell) / len(cell) for c in range(6))
                    along_radius = ((xx * x + xy * y) / radius, (xy * x + yy * y) / radius)
                    inner += area * (along_radius[0] * direction[0] + along_radius[1] * direction[1]) / (OUTER - INNER)
                    outer += area * force * share(x, y)
                for t, w in zip(tread.fields["traction_Pa"], tread.fields["weight_m"], strict=True):
                    outer += w * (t[0] * direction[0] + t[1] * direction[1])
                self.assertClose(inner * WIDTH, outer * WIDTH, 4e-3 * FORCE)

    def recomputed_stress(self, vtu):
        """(place, von Mises stress from the displacement, mean of the file's, area) of every cell."""
        u, stress = vtu.fields["displacement_m"], vtu.fields["von_mises_Pa"]
        for cell in vtu.cells:
            area = vtu.area(cell)
            if abs(area) < 1e-6:
                continue
            gradient = mean_gradient([vtu.points[k] for k in cell], [u[k] for k in cell])
            yield vtu.centre(cell), von_mises(gradient), sum(stress[k] for k in cell) / len(cell), abs(area)

    def test_the_stress_is_that_of_the_displacement(self):
        for vtu in self.positions:
            cells = list(self.recomputed_stress(vtu))
            difference = sum(area * (a - b) ** 2 for _, a, b, area in cells)
            size = sum(area * a * a for _, a, b, area in cells)
            self.assertLess(math.sqrt(difference / size), 0.12)

    def test_the_peak_of_the_stress_is_where_the_displacement_has_it(self):
        for i, vtu in enumerate(self.positions):
            cells = list(self.recomputed_stress(vtu))
            place = max(cells, key=lambda c: c[2])[0]
            top = max(c[1] for c in cells)
            near = [c[1] for c in cells if math.dist(c[0], place) < 0.012]
            self.assertGreater(max(near), 0.8 * top)
            peak = self.analysis["positions"][i]["peak_von_mises_Pa"]
            self.assertClose(max(vtu.fields["von_mises_Pa"]) / peak, 1, 0.25)

    def test_the_peak_of_the_stress_has_its_place_and_its_position(self):
        summary = json.loads((self.run_folder / "summary.json").read_text())["before"]
        row, peak, place = self.history[0], self.analysis["peak_von_mises"], summary["peak_von_mises_place"]
        values = [p["peak_von_mises_Pa"] for p in self.analysis["positions"]]
        worst = values.index(max(values))
        for found in (summary["peak_von_mises_Pa"], float(row["peak_von_mises [Pa]"]), peak["value_Pa"]):
            self.assertClose(found, values[worst], 1e-9 * found)
        for found in (place["radius_m"], float(row["peak_von_mises_radius [m]"])):
            self.assertClose(found, peak["radius_m"], 1e-12)
        for found in (place["azimuth_rad"], math.radians(float(row["peak_von_mises_azimuth [deg]"]))):
            self.assertClose(found, peak["azimuth_rad"], 1e-12)
        for found in (place["load_position_rad"], peak["load_position_rad"],
                      math.radians(float(row["peak_von_mises_position [deg]"]))):
            self.assertClose(found, ground_azimuth(worst), 1e-12)
        # The displacement of that position is as strained there as anywhere, and nowhere else.
        cells = list(self.recomputed_stress(self.positions[worst]))
        top = max(c[1] for c in cells)
        x, y = rotated(peak["radius_m"], 0, peak["azimuth_rad"])
        self.assertGreater(max(c[1] for c in cells if math.dist(c[0], (x, y)) < 0.006), 0.8 * top)
        mirror = rotated(peak["radius_m"], 0, -peak["azimuth_rad"])
        self.assertLess(max(c[1] for c in cells if math.dist(c[0], mirror) < 0.006), 0.6 * top)

    def test_the_summary_tells_what_history_and_analysis_tell(self):
        summary = json.loads((self.run_folder / "summary.json").read_text())
        row, positions = self.history[0], self.analysis["positions"]
        after = {key: value for key, value in summary["after"].items() if key != "errors"}
        self.assertEqual(summary["before"], after)  # of a run without steps
        forces, travels = ([p[key] for p in positions] for key in ("radial_force_N", "travel_m"))
        for key, value in (("objective_J_per_m", float(row["objective [J/m]"])),
                           ("volume_fraction", float(row["volume fraction [-]"])),
                           ("mean_travel_m", float(row["mean_travel [m]"])),
                           ("run_out_m", float(row["run_out [m]"])),
                           ("peak_pressure_Pa", float(row["peak_pressure [Pa]"])),
                           ("largest_strain", max(p["peak_strain"] for p in positions)),
                           ("largest_rotation_rad", max(p["largest_rotation_rad"] for p in positions)),
                           ("linear_theory_error", max(p["linear_theory_error"] for p in positions)),
                           ("travel_by_ring_thickness", max(travels) / (OUTER - INNER)),
                           ("stiffness_N_per_m", sum(forces) / sum(travels))):
            self.assertClose(summary["after"][key], value, 1e-9 * abs(value), key)

    def test_the_shape_gradient_says_that_material_makes_the_wheel_stiffer(self):
        vtu = Vtu(self.run_folder / "shapes/shape_0000.vtu")
        on_holes = [g for g, psi in zip(vtu.fields["shape_gradient_Pa"], vtu.fields["psi_m"], strict=True)
                    if abs(psi) < 1e-4]
        self.assertGreater(len(on_holes), 500)
        self.assertLess(sum(on_holes), 0)
        self.assertLess(max(on_holes), -0.5 * sum(on_holes) / len(on_holes))

    # The deformed wheel

    def pieces(self, name):
        """(level of the colour, lowest 0; polygons in pixels / 10) of a picture of the deformed wheel, each over
        the ones before."""
        svg = (self.run_folder / name).read_text()
        bar = re.findall(r'<rect x="720" y="([0-9.]+)" width="18" height="[0-9.]+" fill="(#[0-9a-f]{6})"/>', svg)
        self.assertEqual(len(bar), 32)
        level = {colour: k for k, (_, colour) in enumerate(sorted(bar, key=lambda e: -float(e[0])))}
        material = re.search(r'viewBox="0 0 6400 6400".*?</svg>', svg, re.DOTALL)[0]
        return [(level[c], subpaths(d)) for c, d in re.findall(r'<path fill="(#[0-9a-f]{6})" d="([^"]*)"', material)]

    def magnification(self, name):
        return float(re.search("displacement \u00d7 ([0-9]+)<", (self.run_folder / name).read_text())[1])

    def press(self, azimuth, magnification):
        """How far the magnified displacement carries the tread below the ground."""
        vtu, ground = self.positions[self.worst], ground_azimuth(self.worst)
        if not self.tread_displacement:
            self.tread_displacement.extend(sorted(
                (math.remainder(math.atan2(y, x) - ground, 2 * math.pi), rotated(u[0], u[1], -ground)[0])
                for (x, y, _), u in zip(vtu.points, vtu.fields["displacement_m"], strict=True)
                if math.hypot(x, y) > OUTER - 1e-6))
        azimuth = math.remainder(azimuth - ground, 2 * math.pi)
        k = min(max(bisect.bisect(self.tread_displacement, (azimuth, 0)), 1), len(self.tread_displacement) - 1)
        (a, down_a), (b, down_b) = self.tread_displacement[k - 1 : k + 1]
        down = down_a + (azimuth - a) / (b - a) * (down_b - down_a)
        return max(0, magnification * down - OUTER * (1 - math.cos(azimuth)))

    def picture_place(self, x, y, u, magnification):
        """The ground is below, y points down, the displacement is magnified, and what would cross the ground is
        moved up: the tread onto it, the rim not at all."""
        px, py = rotated(x + magnification * u[0], y + magnification * u[1], -0.5 * math.pi - ground_azimuth(self.worst))
        py += (math.hypot(x, y) - INNER) / (OUTER - INNER) * self.press(math.atan2(y, x), magnification)
        scale = 3200 / (1.07 * OUTER)
        return 3200 + scale * px, 3200 - scale * py

    def samples(self):
        """Well inside the material, the middles of cells of the file, with the fields' means over them."""
        vtu = self.positions[self.worst]
        for cell in vtu.cells[::17]:
            x, y = vtu.centre(cell)
            if depth(x, y) < -2e-3 and INNER + 2e-3 < math.hypot(x, y) < OUTER - 2e-3:
                u, stress = ([vtu.fields[name][k] for k in cell] for name in ("displacement_m", "von_mises_Pa"))
                yield x, y, [sum(value[d] for value in u) / len(u) for d in (0, 1)], sum(stress) / len(stress)

    def mean_displacement(self, x, y, radius):
        """Of the edge of a hole."""
        vtu = self.positions[self.worst]
        edge = [u for p, u in zip(vtu.points, vtu.fields["displacement_m"], strict=True)
                if math.hypot(p[0] - x, p[1] - y) < radius + 1e-3]
        return [sum(u[d] for u in edge) / len(edge) for d in (0, 1)]

    def test_pictures_show_the_deformed_material_with_the_contact_below(self):
        for name in ("stress.svg", "displacement.svg"):
            inside = boxed(self.pieces(name)[0][1])
            magnification = self.magnification(name)
            for x, y, u, _ in self.samples():
                self.assertTrue(inside(*self.picture_place(x, y, u, magnification)), (name, x, y))
            for x, y, radius in all_holes():
                place = self.picture_place(x, y, self.mean_displacement(x, y, radius), magnification)
                self.assertFalse(inside(*place), (name, x, y))

    def test_the_magnified_tread_lies_on_the_ground_and_not_below(self):
        for name in ("stress.svg", "displacement.svg"):
            lowest = max(y for _, polygons in self.pieces(name) for polygon in polygons for _, y in polygon)
            self.assertClose(lowest, 3200 + 3200 / 1.07, 1.01)

    def expect_levels(self, name, value_of):
        """Places have the colour of the value there."""
        pieces = [(level, boxed(polygons)) for level, polygons in self.pieces(name)]
        magnification, pairs = self.magnification(name), []
        for sample in self.samples():
            place = self.picture_place(*sample[:3], magnification)
            levels = [level for level, inside in pieces if inside(*place)]
            if levels:
                pairs.append((levels[-1], value_of(*sample)))
        self.assertGreater(len(pairs), 200)
        mean_a, mean_b = (sum(p[d] for p in pairs) / len(pairs) for d in (0, 1))
        covariance = sum((a - mean_a) * (b - mean_b) for a, b in pairs)
        a, b = (math.sqrt(sum((p[d] - m) ** 2 for p in pairs)) for d, m in ((0, mean_a), (1, mean_b)))
        self.assertGreater(covariance / (a * b), 0.95)

    def test_the_picture_says_load_position_and_peak(self):
        svg = (self.run_folder / "stress.svg").read_text()
        position = self.analysis["positions"][self.worst]
        for text in (f">{FORCE:.0f} N<", f">{TORQUE:.0f} N m<", f"{math.degrees(ground_azimuth(self.worst)):.4g}\u00b0",
                     f"the most stressed of {POSITIONS} positions",
                     f"travel {1e3 * position['travel_m']:.3g} mm", f"peak {1e-6 * position['peak_von_mises_Pa']:.3g} MPa"):
            self.assertIn(text, svg)

    def test_colours_stand_for_the_stress(self):
        self.expect_levels("stress.svg", lambda x, y, u, stress: stress)

    def test_colours_stand_for_the_displacement_towards_the_ground(self):
        ground = ground_azimuth(self.worst)
        self.expect_levels("displacement.svg", lambda x, y, u, stress: rotated(u[0], u[1], -ground)[0])

    # Saved and read again

    def numbers(self, *arguments):
        return json.loads(run_program(*arguments, "--json"))

    def test_a_run_is_analyzed_as_its_case(self):
        # After no step, the run's last shape is the case's initial one, to the last digit of all numbers.
        analysis = self.numbers("analyze", self.run_folder, "--positions", POSITIONS)
        self.assertNotEqual(analysis.pop("title"), self.analysis["title"])
        self.assertEqual(analysis, {key: value for key, value in self.analysis.items() if key != "title"})

    def test_an_optimized_wheel_is_analyzed_as_its_run_told(self):
        folder = Path(self.temporary.name) / "optimized"
        run_program("run", self.case, "--output", folder, "--iterations", 4)
        summary = json.loads((folder / "summary.json").read_text())["after"]
        first, last = self.numbers("compare", self.case, folder, "--positions", POSITIONS)["wheels"]
        for key in ("mean_travel_m", "stiffness_N_per_m", "peak_pressure_Pa", "peak_von_mises_Pa", "largest_strain",
                    "volume_fraction", "run_out_m"):
            self.assertClose(last[key], summary[key], 1e-12 * abs(summary[key]), key)
            if key != "volume_fraction":
                self.assertGreater(abs(first[key] - last[key]), 1e-4 * abs(last[key]), key)
        positions = self.numbers("analyze", folder, "--positions", POSITIONS)["positions"]
        self.assertClose(max(p["peak_von_mises_Pa"] for p in positions), last["peak_von_mises_Pa"], 1e-6)
        self.assertIn("passed", run_program("verify", folder))

    def test_the_comparison_shows_both_wheels_over_each_other(self):
        folder = Path(self.temporary.name) / "comparison"
        run_program("compare", self.case, self.run_folder, "--output", folder, "--positions", 2)
        paths = re.findall(r' d="([^"]*)"', (folder / "comparison.svg").read_text())
        self.assertEqual(len(paths), 2)
        self.assertEqual(paths[0], paths[1])
        scale = 290 / OUTER
        inside = boxed(subpaths(paths[0]))
        for x, y, expected in probes(0.002):
            self.assertEqual(inside(scale * x, -scale * y), expected, (x, y))

    def test_what_is_no_wheel_is_refused(self):
        empty = Path(self.temporary.name) / "empty"
        empty.mkdir()
        for command in (("analyze", empty), ("verify", empty), ("compare", self.case, empty),
                        ("compare", self.case, empty / "nothing.toml"), ("compare", self.case)):
            code = subprocess.run([program, *map(str, command)], capture_output=True, check=False).returncode
            self.assertEqual(code, 2, command)

    def test_a_resumed_run_has_the_files_of_one_that_was_not_stopped(self):
        straight, stopped = (Path(self.temporary.name) / name for name in ("straight", "stopped"))
        run_program("run", self.case, "--output", straight, "--iterations", 2)
        run_program("run", self.case, "--output", stopped, "--iterations", 1)
        run_program("resume", stopped, "--iterations", 2)
        for name in ("shape.svg", "comparison.svg", "stress.svg", "pressures_final.csv", "rolling/wheel_02.vtu",
                     "shapes/shape_0001.vtu", "shapes/shape_0002.vtu"):
            self.assertEqual((straight / name).read_bytes(), (stopped / name).read_bytes(), name)


if __name__ == "__main__":
    unittest.main()
