"""Exports wheels and reads every file back with a program of others: ezdxf, librsvg, admesh, lib3mf, OpenCASCADE.

What they read is compared with the run's own shape.svg, a polyline, and with the geometry of the case: area, volume,
number of bodies, extent, and at many points whether there is material, which tells a wheel from its mirror image and
from one that is turned. One of the wheels has no symmetry.
usage: export_test.py PROGRAM READ_STEP READ_3MF WRITE_SAMPLE_OUTLINE [CLASS]
"""

import hashlib
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import ezdxf
    import ezdxf.math
    from PIL import Image
except ImportError:
    print("not installed: python3-ezdxf python3-pil")
    sys.exit(77)

program, read_step, read_3mf, write_sample_outline = sys.argv[1:5]
del sys.argv[1:5]

ALL = "dxf,svg,stl,3mf,step,vtu,png"
SECTORS, WIDTH = 7, 0.11
# Azimuth [deg] and radius of the centre, and radius of the hole [m]; in every sector.
HOLES = [(2, 0.266, 0.024), (math.degrees(math.atan2(0.105, 0.262)), math.hypot(0.262, 0.105), 0.028), (40, 0.249, 0.019)]

NO_SYMMETRY = f"""
title = "No symmetry, \\"<&>\\" \u00e9"
[wheel]
width = {WIDTH}
sectors = {SECTORS}
[load]
torque = 80
positions = 3
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
radial_cells = 28
angular_cells = 378
tread_levels = 0
[optimizer]
iterations = 12
[output]
vtu_every = 0
"""

PAPER = """
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
[grid]
tread_levels = 0
[optimizer]
iterations = 12
[output]
vtu_every = 0
"""

SPOKES = """
[wheel]
sectors = 24
[[shape.annulus]]
[[shape.spoke]]
kind = "curved"
count = 24
thickness = 0.010
angle = 12
bend = 40
[grid]
radial_cells = 28
angular_cells = 480
tread_levels = 0
[optimizer]
iterations = 12
[output]
vtu_every = 0
"""


def wheelwright(*arguments, code=0, cwd=None):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, cwd=cwd, check=False)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stdout + done.stderr


# --- Geometry [mm] --------------------------------------------------------------------------------------


def signed_area(polygon):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(polygon[-1:] + polygon[:-1], polygon)) / 2


def boxed(polygons):
    return [(min(p[0] for p in q), max(p[0] for p in q), min(p[1] for p in q), max(p[1] for p in q), q) for q in polygons]


def is_inside(boxes, x, y):
    """Whether an odd number of polygons encloses the point."""
    inside = False
    for left, right, low, high, polygon in boxes:
        if not (left < x < right and low < y < high):
            continue
        ax, ay = polygon[-1]
        for bx, by in polygon:
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                inside = not inside
            ax, ay = bx, by
    return inside


def circle(radius, n=4000):
    return [(radius * math.cos(2 * math.pi * i / n), radius * math.sin(2 * math.pi * i / n)) for i in range(n)]


class Reference:
    """What a wheel must be: polygons in mm with y up, and probes (x, y, is material) away from the edges."""

    def __init__(self, polygons, width, bodies=1):
        self.boxes = boxed(polygons)
        areas = sorted((abs(signed_area(q)) for q in polygons), reverse=True)
        self.area = areas[0] - sum(areas[1:])
        self.width = width
        self.bodies = bodies
        self.n_holes = len(polygons) - 2
        self.probes = []
        margin = 0.4
        for i in range(11):
            for j in range(97):
                r, a = 203 + 13.4 * i, 2 * math.pi * (j + 0.21 + 0.37 * (i % 3)) / 97
                x, y = r * math.cos(a), r * math.sin(a)
                near = [is_inside(self.boxes, x + dx, y + dy) for dx, dy in ((0, 0), (margin, 0), (-margin, 0), (0, margin), (0, -margin))]
                if len(set(near)) == 1:
                    self.probes.append((x, y, near[0]))


def reference_of_run(folder, width):
    """From shape.svg, whose rim and tread are arcs and whose holes are polylines."""
    path = re.search(r'\bd="([^"]*)"', (folder / "shape.svg").read_text())[1]
    holes = []
    for part in path.split("M")[1:]:
        if "A" not in part:
            holes.append([(float(x), -float(y)) for x, y in (p.split() for p in part.rstrip("Z \n").split("L"))])
    return Reference([circle(340), circle(200)] + holes, width)


def exact_reference():
    """The initial shape without symmetry, from its circles."""
    holes = []
    for sector in range(SECTORS):
        for azimuth, distance, radius in HOLES:
            a = math.radians(azimuth) + 2 * math.pi * sector / SECTORS
            cx, cy = 1e3 * distance * math.cos(a), 1e3 * distance * math.sin(a)
            holes.append([(cx + x, cy + y) for x, y in circle(1e3 * radius, 1000)])
    return Reference([circle(340), circle(200)] + holes, 1e3 * WIDTH)


# --- Readers --------------------------------------------------------------------------------------------


def dxf_polygons(path, without=()):
    """By layer, the closed polygons that ezdxf makes of the curves."""
    document = ezdxf.readfile(path)
    assert not document.audit().errors, document.audit().errors
    assert document.dxfversion >= "AC1015" and document.header["$INSUNITS"] == 4
    chains = {}
    parts = [(entity.dxf.layer, entity) for entity in document.modelspace() if entity.dxf.layer not in without]
    for layer, entity in parts:
        kind = entity.dxftype()
        if kind == "LWPOLYLINE":
            assert entity.closed
            parts += [(layer, part) for part in entity.virtual_entities()]
            continue
        if kind == "LINE":
            points = [entity.dxf.start, entity.dxf.end]
        elif kind == "SPLINE":
            points = list(entity.construction_tool().flattening(0.001))
        else:
            points = list(entity.flattening(0.001))
        chains.setdefault(layer, []).append([(p[0], p[1]) for p in points])
    return {layer: joined(parts) for layer, parts in chains.items()}


def joined(chains):
    """Closed polygons of chains whose ends meet."""
    chains, polygons = list(chains), []
    while chains:
        polygon = chains.pop()
        while math.dist(polygon[0], polygon[-1]) > 1e-6:
            ends = [(math.dist(polygon[-1], c[end]), k, end) for k, c in enumerate(chains) for end in (0, -1)]
            miss, k, end = min(ends)
            assert miss < 1e-6, f"open by {miss} mm"
            chain = chains.pop(k)
            polygon += (chain if end == 0 else chain[::-1])[1:]
        polygons.append(polygon)
    return polygons


def read_stl(path):
    data = path.read_bytes()
    (n,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * n and not data.startswith(b"solid")
    return [struct.unpack_from("<12f", data, 84 + 50 * k) for k in range(n)]


def admesh(path):
    # It prints the header of the file, and what lies in its memory behind it.
    text = subprocess.run(["admesh", path], capture_output=True, text=True, errors="replace", check=True).stdout
    numbers = dict(re.findall(r"([A-Z][A-Za-z0-9 ]*?) *[:=] +(-?[\d.]+)", text))
    return {key: float(value) for key, value in numbers.items()}


# --- Tests ----------------------------------------------------------------------------------------------


class ExportedWheel:
    """The checks of all formats; the classes below bring the wheels."""

    name, reference, folder, smooth = "", None, None, True
    planes, cylinders = 2, 2  # in the solid
    most_spline_faces = 0

    def file(self, ending):
        return self.folder / f"{self.name}.{ending}"

    def compare_plane(self, polygons):
        areas = sorted((abs(signed_area(q)) for q in polygons), reverse=True)
        self.assertAlmostEqual(areas[0] - sum(areas[1:]), self.reference.area, delta=1e-4 * self.reference.area)
        boxes = boxed(polygons)
        for x, y, material in self.reference.probes:
            self.assertEqual(is_inside(boxes, x, y), material, (x, y))

    def test_probes_tell_the_wheel_from_its_mirror_image(self):
        wrong = sum(is_inside(self.reference.boxes, x, -y) != m for x, y, m in self.reference.probes)
        if self.name != "paper":
            self.assertGreater(wrong, 20)
        self.assertGreater(len(self.reference.probes), 900)

    def test_dxf(self):
        layers = dxf_polygons(self.file("dxf"))
        self.assertEqual({layer: len(q) for layer, q in layers.items()}, {"OUTER_EDGE": 1, "BORE": 1, "HOLE": self.reference.n_holes})
        self.compare_plane(sum(layers.values(), []))
        for layer, radius in (("OUTER_EDGE", 340), ("BORE", 200)):
            (found,) = ezdxf.readfile(self.file("dxf")).modelspace().query(f'CIRCLE[layer=="{layer}"]')
            self.assertEqual((found.dxf.radius, found.dxf.center), (radius, (0, 0, 0)))

    def test_dxf_splines_are_exact(self):
        kinds = {e.dxftype() for e in ezdxf.readfile(self.file("dxf")).modelspace()}
        self.assertEqual("SPLINE" in kinds, self.smooth)
        for spline in ezdxf.readfile(self.file("dxf")).modelspace().query("SPLINE"):
            self.assertEqual(spline.dxf.degree, 3)
            self.assertEqual(len(spline.knots), len(spline.control_points) + 4)

    def test_svg(self):
        width = 1700
        picture = self.folder / "svg.png"
        subprocess.run(["rsvg-convert", "--width", str(width), "--output", picture, self.file("svg")], check=True)
        self.compare_picture(Image.open(picture).convert("RGBA"), width / 680, lambda p: p[3] / 255)
        text = self.file("svg").read_text()
        self.assertIn('width="680mm" height="680mm" viewBox="0 0 680 680"', text)
        self.assertIn('<g id="wheel" transform="translate(340 340)"', text)
        self.assertNotRegex(re.search(r'\bd="([^"]*)"', text)[1], "[Aa]")

    def test_png(self):
        picture = Image.open(self.file("png"))
        self.assertEqual(picture.size, (1600, 1600))
        self.compare_picture(picture.convert("RGB"), 780 / 340, lambda p: (255 - p[0]) / (255 - 59))  # from white to the blue's red

    def compare_picture(self, image, pixels_per_millimetre, coverage):
        """The coverage of a pixel by material is from 0 to 1, between them at edges."""
        middle = image.size[0] / 2
        pixels = image.load()
        covered = sum(coverage(p) for p in image.getdata())
        self.assertAlmostEqual(covered / pixels_per_millimetre**2, self.reference.area, delta=5e-4 * self.reference.area)
        for x, y, material in self.reference.probes:
            pixel = pixels[int(middle + x * pixels_per_millimetre), int(middle - y * pixels_per_millimetre)]
            self.assertEqual(coverage(pixel) > 0.5, material, (x, y))

    def test_stl(self):
        self.compare_mesh(self.file("stl"))

    def test_3mf(self):
        stl = self.folder / "from_3mf.stl"
        told = subprocess.run([read_3mf, self.file("3mf"), stl], capture_output=True, text=True, check=True).stdout
        self.assertEqual(told, "object wheel\nunit 1\nobjects 1\nwarnings 0\n")  # millimetres
        self.compare_mesh(stl)

    def compare_mesh(self, path):
        facts = admesh(path)
        volume = self.reference.area * self.reference.width
        self.assertAlmostEqual(facts["Volume"], volume, delta=2e-4 * volume)
        self.assertEqual(facts["Number of parts"], self.reference.bodies)
        for fault in ("Degenerate facets", "Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges",
                      "Normals fixed", "Total disconnected facets"):
            self.assertEqual(facts[fault], 0, fault)
        triangles = read_stl(path)
        self.assertEqual(min(t[5] for t in triangles), 0)
        self.assertAlmostEqual(max(t[5] for t in triangles), self.reference.width, places=4)
        # The upper side, where normals point upwards.
        upper = [((t[3], t[4]), (t[6], t[7]), (t[9], t[10])) for t in triangles if t[5] == t[8] == t[11] > 0]
        self.assertTrue(all(signed_area(list(t)) > 0 for t in upper))
        self.assertAlmostEqual(sum(signed_area(list(t)) for t in upper), self.reference.area, delta=2e-4 * self.reference.area)
        boxes = boxed([list(t) for t in upper])
        for x, y, material in self.reference.probes[::5]:
            self.assertEqual(is_inside(boxes, x, y), material, (x, y))

    def test_step(self):
        z = 0.3 * self.reference.width
        points = "".join(f"{x} {y} {z}\n" for x, y, _ in self.reference.probes)
        lines = subprocess.run([read_step, self.file("step")], input=points, capture_output=True, text=True, check=True).stdout.splitlines()
        facts = dict(line.split(" ", 1) for line in lines if " " in line)
        self.assertEqual((facts["unit"], facts["valid"], facts["solids"]), ("millimetre", "1", str(self.reference.bodies)))
        volume = self.reference.area * self.reference.width
        self.assertAlmostEqual(float(facts["volume"]), volume, delta=1e-4 * volume)
        self.assertAlmostEqual(float(facts["usual_volume"]), volume, delta=1e-3 * volume)
        self.assertEqual((int(facts["plane"]), int(facts["cylinder"])), (self.planes, self.cylinders))
        self.assertEqual("b_spline" in facts, self.smooth)
        self.assertLessEqual(int(facts.get("b_spline", 0)), self.most_spline_faces)
        self.assertNotIn("other", facts)
        for corner, at in (("lower", (-340, -340, 0)), ("upper", (340, 340, self.reference.width))):
            for value, expected in zip(facts[corner].split(), at):
                self.assertAlmostEqual(float(value), expected, delta=1e-3)
        found = [line == "in" for line in lines if " " not in line]
        self.assertEqual(found, [material for _, _, material in self.reference.probes])

    def test_vtu(self):
        xml, data = self.file("vtu").read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
        arrays = {name: (kind, int(offset)) for kind, name, offset in
                  re.findall(r'<DataArray type="(\w+)" Name="(\w+)".*?offset="(\d+)"', xml.decode())}
        self.assertIn('Name="psi_mm"', xml.decode())

        def values(name):
            kind, offset = arrays[name]
            (size,) = struct.unpack_from("<Q", data, offset)
            code = {"Float32": "f", "Int32": "i", "UInt8": "B"}[kind]
            return struct.unpack_from(f"<{size // struct.calcsize(code)}{code}", data, offset + 8)

        numbers, connectivity, offsets = values("Points"), values("connectivity"), values("offsets")
        points = list(zip(numbers[0::3], numbers[1::3]))
        cells = [[points[i] for i in connectivity[a:b]] for a, b in zip((0, *offsets), offsets)]
        self.assertAlmostEqual(sum(map(signed_area, cells)), self.reference.area, delta=1e-3 * self.reference.area)
        boxes = boxed(cells)
        for x, y, material in self.reference.probes[::5]:
            self.assertEqual(is_inside(boxes, x, y), material, (x, y))

    def test_the_same_input_gives_the_same_bytes(self):
        again = self.folder / "again"
        wheelwright("export", self.source, "--format", ALL, "--output", again)
        for ending in ALL.split(","):
            self.assertEqual((again / f"{self.name}.{ending}").read_bytes(), self.file(ending).read_bytes(), ending)


class OptimizedWithoutSymmetry(ExportedWheel, unittest.TestCase):
    name = "no_symmetry"
    most_spline_faces = 4 * SECTORS * len(HOLES)

    @classmethod
    def setUpClass(cls):
        cls.source = optimized(NO_SYMMETRY, cls.name)
        cls.folder = exported(cls.source, cls.name)
        cls.cylinders = round_edges(cls)
        cls.reference = reference_of_run(cls.source, 1e3 * WIDTH)


class InitialWithoutSymmetry(ExportedWheel, unittest.TestCase):
    name, smooth, cylinders = "circles", False, 2 + SECTORS * len(HOLES)

    @classmethod
    def setUpClass(cls):
        cls.source = temporary / "circles.toml"
        # A grid on which the level set's circles are round to a micrometre.
        cls.source.write_text(NO_SYMMETRY.replace("radial_cells = 28", "radial_cells = 56").replace("= 378", "= 1540"))
        cls.folder = exported(cls.source, cls.name)
        cls.reference = exact_reference()

    def test_circles_are_where_they_were_given(self):
        found = sorted((round(c.dxf.center.x, 2), round(c.dxf.center.y, 2), round(c.dxf.radius, 2))
                       for c in ezdxf.readfile(self.file("dxf")).modelspace().query('CIRCLE[layer=="HOLE"]'))
        given = []
        for sector in range(SECTORS):
            for azimuth, distance, radius in HOLES:
                a = math.radians(azimuth) + 2 * math.pi * sector / SECTORS
                given.append((1e3 * distance * math.cos(a), 1e3 * distance * math.sin(a), 1e3 * radius))
        for f, g in zip(found, sorted(given), strict=True):
            for a, b in zip(f, g):
                self.assertAlmostEqual(a, b, delta=0.011)


class ThePapersWheel(ExportedWheel, unittest.TestCase):
    name = "paper"
    most_spline_faces = 3 * 16

    @classmethod
    def setUpClass(cls):
        cls.source = optimized(PAPER, cls.name)
        cls.folder = exported(cls.source, cls.name)
        cls.cylinders = round_edges(cls)
        cls.reference = reference_of_run(cls.source, 120)


class Spokes(ExportedWheel, unittest.TestCase):
    """Windows with sharp corners and straight sides, which need many cubics."""

    name = "spokes"
    most_spline_faces = 5 * 24

    @classmethod
    def setUpClass(cls):
        cls.source = optimized(SPOKES, cls.name)
        cls.folder = exported(cls.source, cls.name)
        cls.cylinders = round_edges(cls)
        cls.reference = reference_of_run(cls.source, 120)


class AllKindsOfCurves(ExportedWheel, unittest.TestCase):
    """An outline that was made by hand: lines, arcs both ways, a spline with corners."""

    name, planes, cylinders = "sample", 2 + 3, 2 + 3
    most_spline_faces = 1

    @classmethod
    def setUpClass(cls):
        cls.folder = temporary / cls.name
        cls.folder.mkdir()
        told = subprocess.run([write_sample_outline, cls.folder], capture_output=True, text=True, check=True).stdout
        loops = [[tuple(map(float, point.split())) for point in loop.split("\n")] for loop in told.strip().split("\n\n")]
        cls.reference = Reference(loops, 50)

    def test_dxf_entities(self):
        kinds = [(e.dxftype(), e.dxf.layer) for e in ezdxf.readfile(self.file("dxf")).modelspace()]
        self.assertEqual(kinds, [("CIRCLE", "OUTER_EDGE"), ("CIRCLE", "BORE"), ("LWPOLYLINE", "HOLE"), ("SPLINE", "HOLE"), ("ARC", "HOLE"),
                                 ("LINE", "HOLE")])

    test_vtu = None  # its shape has no holes
    test_the_same_input_gives_the_same_bytes = None


def optimized(case, name):
    file = temporary / f"{name}.toml"
    file.write_text(case)
    wheelwright("run", file, "--output", temporary / name, "--threads", 1)
    return temporary / name


def round_edges(wheel):
    """Circles and arcs of the drawing: a hole that lies on a band has an arc there."""
    entities = ezdxf.readfile(wheel.folder / f"{wheel.source.name}.dxf").modelspace()
    return len(entities.query("CIRCLE ARC"))


def exported(source, name):
    folder = temporary / f"{name}_export"
    wheelwright("export", source, "--format", ALL, "--output", folder)
    return folder


def is_in_section(triangles, z, x, y):
    """Whether a line from (x, y, z) leaves the solid an odd number of times."""
    crossings = 0
    for corners in triangles:
        heights = [p[2] > z for p in corners]
        if len(set(heights)) == 1:
            continue
        ends = []
        for k in range(3):
            a, b = corners[k], corners[(k + 1) % 3]
            if heights[k] != heights[(k + 1) % 3]:
                t = (z - a[2]) / (b[2] - a[2])
                ends.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
        (ax, ay), (bx, by) = ends
        crossings += (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax)
    return crossings % 2 == 1


LAYERED = """
[wheel]
sectors = 5
[[material.layer]]
name = "core"
outer_radius = 0.23
youngs_modulus = 2e9
poissons_ratio = 0.3
[[material.layer]]
name = "tyre"
inner_radius = 0.30
youngs_modulus = 30e6
poissons_ratio = 0.45
[[holes.circle]]
center = [0.27, 0.03]
radius = 0.034
[[holes.circle]]
center = [0.15, 0.19]
radius = 0.02
[optimizer]
rim_band = 0.005
[grid]
radial_cells = 28
angular_cells = 400
"""


class Layers(unittest.TestCase):
    """A wheel of three materials whose holes cross from one to another, without mirror symmetry."""

    NAMES = ["core", "material", "tyre"]

    @classmethod
    def setUpClass(cls):
        cls.case = temporary / "layered.toml"
        cls.case.write_text(LAYERED)
        cls.folder = temporary / "layered_export"
        wheelwright("export", cls.case, "--format", ALL, "--by-layer", "--output", cls.folder)
        cls.whole = cls.step("layered")

    @classmethod
    def step(cls, stem):
        lines = subprocess.run([read_step, cls.folder / f"{stem}.step"], input="", capture_output=True, text=True,
                               check=True).stdout.splitlines()
        facts = dict(line.split(" ", 1) for line in lines if not line.startswith("body "))
        facts["bodies"] = [line.split(" ", 5)[1:] for line in lines if line.startswith("body ")]
        return facts

    def test_step_has_a_named_valid_body_per_layer(self):
        bodies = self.whole["bodies"]
        self.assertEqual([name for *_, name in bodies], self.NAMES)
        self.assertEqual(self.whole["valid"], "1")
        for valid, _, solids, colour, name in bodies:
            self.assertEqual((valid, solids), ("1", "1"), name)
            self.assertNotEqual(colour, "none")
        self.assertEqual(len({colour for _, _, _, colour, _ in bodies}), 3)

    def test_the_bodies_add_up_to_the_wheel(self):
        one = temporary / "one_material.toml"  # the same shape
        one.write_text(re.sub(r"(?s)\[\[material.layer\]\].*?(?=\[\[(?!material))", "", LAYERED))
        wheelwright("export", one, "--format", "step", "--output", self.folder)
        volume = float(self.step("one_material")["volume"])
        volumes = [float(body[1]) for body in self.whole["bodies"]]
        self.assertAlmostEqual(sum(volumes) / volume, 1, delta=1e-6)
        for of_layer, name in zip(volumes, self.NAMES):
            alone = self.step(f"layered-{name}")
            self.assertEqual(alone["valid"], "1")
            self.assertAlmostEqual(float(alone["volume"]) / of_layer, 1, delta=1e-9)

    def test_3mf_has_a_named_object_per_layer(self):
        mesh = self.folder / "of_3mf.stl"
        told = subprocess.run([read_3mf, self.folder / "layered.3mf", mesh], capture_output=True, text=True, check=True).stdout
        self.assertIn("".join(f"object {name}\n" for name in self.NAMES), told)
        self.assertIn("objects 3\nwarnings 0", told)
        facts = admesh(mesh)
        volume = float(self.whole["volume"])
        self.assertAlmostEqual(facts["Volume"], volume, delta=2e-4 * volume)
        self.assertEqual(facts["Number of parts"], 3)

    def test_dxf_has_a_layer_per_layer(self):
        drawing = ezdxf.readfile(self.folder / "layered.dxf")
        self.assertFalse(drawing.audit().has_errors)
        for name in self.NAMES:
            self.assertIn(name, drawing.layers)
            self.assertGreater(len(drawing.modelspace().query(f'*[layer=="{name}"]')), 1)
        self.assertEqual({entity.dxf.layer for entity in drawing.modelspace()}, set(self.NAMES))

    def test_svg_has_a_group_per_layer(self):
        text = (self.folder / "layered.svg").read_text()
        self.assertEqual(re.findall(r'inkscape:label="(\w+)"', text), self.NAMES)

    def test_vtu_has_the_number_of_the_layer(self):
        xml, data = (self.folder / "layered.vtu").read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
        offset = int(re.search(rb'Name="material"[^>]*offset="(\d+)"', xml)[1])
        size = struct.unpack_from("<Q", data, offset)[0]
        numbers = struct.unpack_from(f"<{size // 4}i", data, offset + 8)
        self.assertEqual(set(numbers), {0, 1, 2})

    def test_the_same_input_gives_the_same_bytes(self):
        again = temporary / "layered_again"
        wheelwright("export", self.case, "--format", ALL, "--by-layer", "--output", again)
        for file in sorted(self.folder.glob("layered*")):
            if file.name != "of_3mf.stl":
                self.assertEqual(file.read_bytes(), (again / file.name).read_bytes(), file.name)

    def test_files_by_layer_only_on_request(self):
        folder = temporary / "layered_whole"
        wheelwright("export", self.case, "--output", folder)
        self.assertEqual(sorted(file.name for file in folder.glob("layered*")), ["layered.dxf", "layered.stl", "layered.svg"])

    def test_spokes_end_at_a_band_without_a_skin(self):
        case = temporary / "shear-band.toml"
        wheelwright("init", case, "--preset", "shear-band")
        folder = temporary / "shear_export"
        wheelwright("export", case, "--format", "step,stl,3mf", "--by-layer", "--output", folder)
        for name in ("material", "band", "tread"):
            facts = admesh(folder / f"shear-band-{name}.stl")
            self.assertEqual((facts["Number of parts"], facts["Degenerate facets"]), (1, 0), name)


class Solid(unittest.TestCase):
    """A wheel in 3D without symmetry, whose holes are cylinders, one of them a little conical."""

    FORMATS = "stl,3mf,vtu,vtp,png"
    CYLINDERS = NO_SYMMETRY.replace("[wheel]", "[wheel]\ndimension = 3").replace("[grid]", "[grid]\naxial_cells = 3")

    @classmethod
    def setUpClass(cls):
        cone = f"[[holes.tapered]]\nprofile = [[{-WIDTH / 2}, 0.01895], [0, 0.019], [{WIDTH / 2}, 0.01905]]"
        ring = re.search(r"\[\[holes.ring\]\]\n(count = \d+\ncenter_radius = 0.249)\nradius = 0.019", cls.CYLINDERS)
        cls.source = temporary / "solid.toml"
        cls.source.write_text(cls.CYLINDERS.replace(ring[0], f"{cone}\n{ring[1]}"))
        cls.folder = temporary / "solid_export"
        cls.told = wheelwright("export", cls.source, "--format", cls.FORMATS, "--output", cls.folder)
        cls.reference = exact_reference()
        cls.triangles = [(t[3:6], t[6:9], t[9:12]) for t in read_stl(cls.folder / "solid.stl")]

    def test_stl_is_closed_and_has_the_volume(self):
        found = admesh(self.folder / "solid.stl")
        self.assertEqual(found["Number of parts"], 1)
        for fault in ("Degenerate facets", "Edges fixed", "Facets removed", "Facets added", "Facets reversed",
                      "Backwards edges", "Normals fixed", "Total disconnected facets"):
            self.assertEqual(found[fault], 0, fault)
        volume = self.reference.area * 1e3 * WIDTH
        # The surface lies up to the tolerance of 0.1 mm inside of the holes.
        self.assertAlmostEqual(found["Volume"], volume, delta=2e-3 * volume)
        heights = [p[2] for t in self.triangles for p in t]
        self.assertEqual((min(heights), max(heights)), (0, struct.unpack("f", struct.pack("f", 1e3 * WIDTH))[0]))

    def test_normals_point_outwards(self):
        for nx, ny, nz, ax, ay, az, bx, by, bz, cx, cy, cz in read_stl(self.folder / "solid.stl")[::37]:
            u, v = (bx - ax, by - ay, bz - az), (cx - ax, cy - ay, cz - az)
            cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            self.assertGreater(nx * cross[0] + ny * cross[1] + nz * cross[2], 0)

    def test_material_is_where_the_case_has_it(self):
        slab = [t for t in self.triangles if min(p[2] for p in t) <= 41 <= max(p[2] for p in t)]
        probes = self.reference.probes[::3]
        wrong = [(x, y) for x, y, material in probes if is_in_section(slab, 41, x, y) != material]
        self.assertEqual(wrong, [])
        mirrored = sum(is_in_section(slab, 41, x, -y) != material for x, y, material in probes)
        self.assertGreater(mirrored, 10)

    def test_3mf_has_the_same_triangles(self):
        copy = temporary / "solid_3mf.stl"
        told = subprocess.run([read_3mf, self.folder / "solid.3mf", copy], capture_output=True, text=True, check=True).stdout
        self.assertIn("objects 1\nwarnings 0", told)
        found = admesh(copy)
        self.assertEqual(found["Number of facets"], len(self.triangles))
        self.assertEqual((found["Number of parts"], found["Edges fixed"], found["Degenerate facets"]), (1, 0, 0))

    def test_report(self):
        self.assertRegex(self.told, r"surface +\d+ triangles, closed")
        # One handle of the ring and one per hole.
        self.assertRegex(self.told, rf"bodies +1, with {1 + SECTORS * len(HOLES)} handles and 0 closed cavities")
        error = float(re.search(r"mm\^3, ([+-][\d.e+-]+) of", self.told)[1])
        self.assertLess(abs(error), 1e-3)
        self.assertLessEqual(float(re.search(r"deviation +([\d.]+) mm", self.told)[1]), 0.1)

    def test_a_smaller_tolerance_gives_more_triangles(self):
        told = wheelwright("export", self.source, "--tolerance", 0.02, "--output", temporary / "solid_fine")
        self.assertGreater(int(re.search(r"surface +(\d+)", told)[1]), len(self.triangles))
        self.assertLessEqual(float(re.search(r"deviation +([\d.]+) mm", told)[1]), 0.02)

    def test_png_shows_a_wheel_on_white(self):
        image = Image.open(self.folder / "solid.png")
        self.assertEqual(image.size, (1600, 1600))
        colours = [image.getpixel((x, y)) for x in range(0, 1600, 20) for y in range(0, 1600, 20)]
        white = sum(c == (255, 255, 255) for c in colours) / len(colours)
        self.assertTrue(0.3 < white < 0.8, white)
        self.assertGreater(len(set(colours)), 100)  # lit, not of one colour

    def test_formats_of_plane_wheels_are_refused(self):
        folder = Path(tempfile.mkdtemp(dir=temporary))
        for name in ("dxf", "svg"):
            told = wheelwright("export", self.source, "--format", f"stl,{name}", "--output", folder, code=2)
            self.assertIn(name, told)
            self.assertIn("vtp", told)
        self.assertEqual(os.listdir(folder), [])

    def test_a_wheel_that_is_the_same_along_the_axle_has_the_files_of_a_plane_one(self):
        plane, prism = temporary / "plane.toml", temporary / "prism.toml"
        plane.write_text(NO_SYMMETRY)
        prism.write_text(self.CYLINDERS)
        folder = temporary / "prism_export"
        told = wheelwright("export", prism, "--format", "dxf,svg,stl,step", "--output", folder)
        self.assertIn("the same all along the axle", told)
        wheelwright("export", plane, "--format", "dxf", "--output", folder)
        self.assertEqual((folder / "prism.dxf").read_bytes(), (folder / "plane.dxf").read_bytes())
        # A format of surfaces has the surface.
        self.assertIn("triangles", wheelwright("export", prism, "--format", "vtp", "--output", folder))

    def test_the_same_input_gives_the_same_bytes(self):
        again = temporary / "solid_again"
        wheelwright("export", self.source, "--format", self.FORMATS, "--output", again)
        for ending in self.FORMATS.split(","):
            self.assertEqual((again / f"solid.{ending}").read_bytes(), (self.folder / f"solid.{ending}").read_bytes(), ending)


CONES = """
[wheel]
dimension = 3
width = 0.11
sectors = 7
[[holes.tapered]]
count = 7
center_radius = 0.265
profile = [[-0.055, 0.014], [0, 0.022], [0.055, 0.030]]
phase = 11
[material]
poissons_ratio = 0.3
[grid]
radial_cells = 28
angular_cells = 252
axial_cells = 4
level_set_degree = 2
tread_levels = 0
"""


class Sections(unittest.TestCase):
    """Sections of cones across the axle, which are round; in mm."""

    @classmethod
    def setUpClass(cls):
        cls.case = temporary / "cones.toml"
        cls.case.write_text(CONES)
        cls.folder = temporary / "cones_export"
        cls.told = wheelwright("export", cls.case, "--format", "stl", "--sections", "0,37.5,110", "--output", cls.folder)

    def test_they_are_where_they_are_asked_for(self):
        self.assertEqual(sorted(file.name for file in self.folder.glob("cones*")),
                         sorted(["cones.stl"] + [f"cones-z{z}.{kind}" for z in ("0", "37.5", "110") for kind in ("dxf", "svg")]))
        for z in (0, 37.5, 110):
            radius = 14 + 16 * z / 110
            layers = dxf_polygons(self.folder / f"cones-z{z}.dxf")
            self.assertEqual(len(layers["HOLE"]), 7)
            azimuths = []
            for hole in layers["HOLE"]:
                corners = [(p, q, p[0] * q[1] - q[0] * p[1]) for p, q in zip(hole, hole[1:] + hole[:1])]
                area = sum(twice for _, _, twice in corners) / 2
                x, y = (sum((p[i] + q[i]) * twice for p, q, twice in corners) / (6 * area) for i in range(2))
                self.assertAlmostEqual(math.sqrt(abs(area) / math.pi), radius, delta=0.02 * radius)
                self.assertAlmostEqual(math.hypot(x, y), 265, delta=0.2)
                azimuths.append(math.degrees(math.atan2(y, x)) % (360 / 7))
            for azimuth in azimuths:
                self.assertAlmostEqual(azimuth, 11, delta=0.1)
            svg = (self.folder / f"cones-z{z}.svg").read_text()
            self.assertIn("material", svg)

    def test_planes_beside_the_wheel_and_plane_wheels_are_refused(self):
        folder = Path(tempfile.mkdtemp(dir=temporary))
        for z in ("-1", "110.1", "0,111"):
            told = wheelwright("export", self.case, f"--sections={z}", "--output", folder, code=2)
            self.assertIn("--sections", told)
        plane = temporary / "plane_without_sections.toml"
        plane.write_text(NO_SYMMETRY)
        wheelwright("export", plane, "--sections", "10", "--output", folder, code=2)
        wheelwright("export", self.case, "--sections", "middle", "--output", folder, code=2)
        self.assertEqual(os.listdir(folder), [])


GROOVE = """
[[holes.groove]]
inner_radius = {inner}
outer_radius = {outer}
depth = 0.03
fillet = 0.008
side = "larger_z"
"""


def cones_with_groove(inner, outer):
    """Cones through the wheel, and a groove in one of its side faces; without mirror symmetry."""
    return CONES.replace("[material]", GROOVE.format(inner=inner, outer=outer) + "[material]")


class Faces(unittest.TestCase):
    """STEP files of wheels whose shape changes along the axle."""

    @classmethod
    def setUpClass(cls):
        cls.folder = temporary / "faces_export"
        cls.told = {}
        # Where holes cross, the level set has kinks inside of cells, which only coarse surfaces follow.
        cls.tolerance = {"apart": 0.1, "crossing": 0.6}
        for name, inner, outer in (("apart", 0.2115, 0.229), ("crossing", 0.215, 0.26)):
            (temporary / f"{name}.toml").write_text(cones_with_groove(inner, outer))
            cls.told[name] = wheelwright("export", temporary / f"{name}.toml", "--format", "step", "--tolerance", cls.tolerance[name],
                                         "--output", cls.folder)

    def number(self, name, pattern):
        return float(re.search(pattern, self.told[name])[1])

    def check(self, name):
        """The facts of a solid that is checked for what both kinds have in common."""
        points, expected = [], []
        for i in range(300):
            radius, z = 232 + 0.66 * (i * 37 % 100), 1.5 + 1.07 * (i * 61 % 101)
            azimuth = math.radians(11) + 2 * math.pi * i / 7 + 0.003 * (i * 29 % 103 - 51)
            x, y = radius * math.cos(azimuth), radius * math.sin(azimuth)
            angles = [math.radians(11) + 2 * math.pi * k / 7 for k in range(7)]
            gap = min(math.hypot(x - 265 * math.cos(a), y - 265 * math.sin(a)) for a in angles) - (14 + 16 * z / 110)
            if abs(gap) > 1 and not (z > 75 and 205 < radius < 265):  # beside the groove
                points.append((x, y, z))
                expected.append(gap > 0)
        self.assertGreater(min(sum(expected), len(expected) - sum(expected)), 30)
        facts, found = Turned.read_step(self.folder / f"{name}.step", points)
        self.assertEqual(found, expected)
        self.assertEqual((facts["unit"], facts["valid"], facts["solids"]), ("millimetre", "1", "1"))
        volume, told = float(facts["volume"]), self.number(name, r"(\d+) mm\^3, \S+ of the surface's")
        self.assertAlmostEqual(volume, told, delta=1e-6 * told)
        self.assertAlmostEqual(float(facts["usual_volume"]), told, delta=3e-4 * told)
        of_level_set = self.number(name, r"volume +(\d+)") / (1 + self.number(name, r"volume .*mm\^3, (\S+) of"))
        self.assertAlmostEqual(volume, of_level_set, delta={"apart": 1e-4, "crossing": 1e-3}[name] * volume)
        self.assertLessEqual(self.number(name, r"\n +deviation ([\d.]+) mm"), self.tolerance[name])
        for corner, at in (("lower", (-340, -340, 0)), ("upper", (340, 340, 110))):
            for value, expected_value in zip(facts[corner].split(), at):
                self.assertAlmostEqual(float(value), expected_value, delta=1e-3)
        self.assertEqual(facts["cylinder"], "2")
        return facts

    def test_holes_are_smooth_faces(self):
        facts = self.check("apart")
        self.assertIn("32 B-spline surfaces", self.told["apart"])
        # Four for each of the cones and for the groove, which divides one of the side faces.
        self.assertEqual((facts["b_spline"], facts["plane"]), ("32", "3"))
        self.assertNotIn("other", facts)

    def test_holes_that_branch_are_facets(self):
        self.assertIn("no smooth faces: the surface of a hole branches", self.told["crossing"])
        facts = self.check("crossing")
        self.assertEqual(int(facts["plane"]) + 2, self.number("crossing", r"STEP +(\d+) faces"))
        self.assertLess(int(facts["plane"]), 10000)

    def test_the_same_input_gives_the_same_bytes(self):
        again = temporary / "faces_again"
        wheelwright("export", temporary / "apart.toml", "--format", "step", "--output", again)
        self.assertEqual((again / "apart.step").read_bytes(), (self.folder / "apart.step").read_bytes())


TURNED = """
[wheel]
dimension = 3
width = 0.11
sectors = 64
[[holes.groove]]
inner_radius = 0.225
outer_radius = 0.31
depth = 0.05
fillet = 0.02
side = "smaller_z"
[[holes.groove]]
inner_radius = 0.24
outer_radius = 0.32
depth = 0.03
fillet = 0.015
side = "larger_z"
[material]
poissons_ratio = 0.3
[grid]
radial_cells = 28
angular_cells = 192
axial_cells = 12
degree = 1
level_set_degree = 2
tread_levels = 0
[optimizer]
made = "turned"
"""


class Turned(unittest.TestCase):
    """A body of revolution without mirror symmetry, exported by its profile; in mm."""

    GROOVES = [(225, 310, 0, 50, 20), (240, 320, 110, -30, 15)]  # radii, side face, depth along z, fillet

    @classmethod
    def setUpClass(cls):
        cls.case = temporary / "turned.toml"
        cls.case.write_text(TURNED)
        cls.folder = temporary / "turned_export"
        cls.told = wheelwright("export", cls.case, "--format", "dxf,svg,step,stl", "--output", cls.folder)
        volume = math.pi * (340**2 - 200**2) * 110
        for low, high, _, depth, fillet in cls.GROOVES:  # Pappus: a square without its quarter of a disc is missing at each corner
            corner = fillet**2 * (1 - math.pi / 4)
            volume -= math.pi * (high**2 - low**2) * abs(depth) - 2 * math.pi * corner * (low + high)
        cls.volume = volume

    @staticmethod
    def read_step(path, points=()):
        text = "".join(f"{x} {y} {z}\n" for x, y, z in points)
        lines = subprocess.run([read_step, path], input=text, capture_output=True, text=True, check=True).stdout.splitlines()
        facts = dict(line.split(" ", 1) for line in lines if " " in line and not line.startswith("body "))
        facts["bodies"] = [line.split(" ", 5)[1:] for line in lines if line.startswith("body ")]
        return facts, [line == "in" for line in lines if " " not in line]

    def is_material(self, z, radius, margin):
        """Nothing within a margin of an edge."""
        distances = [min(radius - 200, 340 - radius, z, 110 - z)]
        for low, high, face, depth, fillet in self.GROOVES:
            along, across = abs(z - face), radius - (low + high) / 2
            p, q = along - abs(depth) + fillet, abs(across) - (high - low) / 2 + fillet
            distances.append(math.hypot(max(p, 0), max(q, 0)) + min(max(p, q), 0) - fillet)
        nearest = min(distances, key=abs)
        return None if abs(nearest) < margin else all(d > 0 for d in distances)

    def test_step(self):
        points, expected = [], []
        for i in range(40):
            for j in range(23):
                z, radius, azimuth = 2 + 2.7 * i, 203 + 6 * j, 1.3 * i + 0.7 * j
                if (material := self.is_material(z, radius, 0.5)) is not None:
                    points.append((radius * math.cos(azimuth), radius * math.sin(azimuth), z))
                    expected.append(material)
        self.assertGreater(len(points), 800)
        facts, found = self.read_step(self.folder / "turned.step", points)
        self.assertEqual(found, expected)
        self.assertEqual((facts["unit"], facts["valid"], facts["solids"]), ("millimetre", "1", "1"))
        # The level set rounds the edges of the fillets, where it has kinks.
        self.assertAlmostEqual(float(facts["volume"]), self.volume, delta=5e-4 * self.volume)
        told = float(re.search(r"volume +(\d+) mm\^3", self.told)[1])
        self.assertAlmostEqual(float(facts["volume"]), told, delta=1e-6 * told)
        self.assertAlmostEqual(float(facts["usual_volume"]), told, delta=3e-4 * told)
        # Rim and tread; the side faces, which the grooves divide, and at most the bottoms of the grooves.
        self.assertGreaterEqual(int(facts["cylinder"]), 2)
        self.assertIn(int(facts["plane"]), range(4, 7))
        self.assertLess(int(facts["other"]), 60)
        for corner, at in (("lower", (-340, -340, 0)), ("upper", (340, 340, 110))):
            for value, expected_value in zip(facts[corner].split(), at):
                self.assertAlmostEqual(float(value), expected_value, delta=1e-3)

    def test_report(self):
        self.assertRegex(self.told, r"profile +1 loop: \d+ lines")
        self.assertRegex(self.told, r"bodies +1, with 0 closed cavities")
        self.assertLess(abs(float(re.search(r"mm\^3, ([+-][\d.e+-]+) of", self.told)[1])), 1e-4)
        self.assertLessEqual(float(re.search(r"deviation +([\d.]+) mm", self.told)[1]), 0.01)
        # Between the bottoms of the grooves.
        self.assertAlmostEqual(float(re.search(r"smallest wall +([\d.]+) mm", self.told)[1]), 20, delta=0.5)

    def test_dxf_is_the_profile_above_the_axle(self):
        layers = dxf_polygons(self.folder / "turned.dxf", without=("AXLE",))
        (polygon,) = layers["OUTER_EDGE"]
        self.assertAlmostEqual(min(z for z, _ in polygon), 0, places=9)
        self.assertAlmostEqual(max(z for z, _ in polygon), 110, places=9)
        volume = 2 * math.pi * sum((bz - az) * -(ar * ar + ar * br + br * br) / 6
                                   for (az, ar), (bz, br) in zip(polygon, polygon[1:] + polygon[:1]))
        self.assertAlmostEqual(abs(volume), self.volume, delta=5e-4 * self.volume)
        drawing = ezdxf.readfile(self.folder / "turned.dxf")
        (axle,) = drawing.modelspace().query('LINE[layer=="AXLE"]')
        self.assertEqual((axle.dxf.start.y, axle.dxf.end.y), (0, 0))
        self.assertEqual(drawing.layers.get("AXLE").dxf.linetype, "CENTER")

    def test_svg_is_the_profile_above_the_axle(self):
        margin, scale = 0.02 * 340, 5
        picture = self.folder / "svg.png"
        subprocess.run(["rsvg-convert", "--width", str(round(scale * (110 + 2 * margin))), "--output", picture,
                        self.folder / "turned.svg"], check=True)
        pixels = Image.open(picture).convert("RGBA").load()
        for i in range(40):
            for j in range(23):
                z, radius = 2 + 2.7 * i, 203 + 6 * j
                if (material := self.is_material(z, radius, 0.5)) is not None:
                    self.assertEqual(pixels[int(scale * (margin + z)), int(scale * (margin + 340 - radius))][3] > 128, material, (z, radius))

    def test_stl_is_the_surface(self):
        found = admesh(self.folder / "turned.stl")
        self.assertEqual(found["Number of parts"], 1)
        self.assertAlmostEqual(found["Volume"], self.volume, delta=2e-3 * self.volume)

    def test_the_same_input_gives_the_same_bytes(self):
        again = temporary / "turned_again"
        wheelwright("export", self.case, "--format", "dxf,svg,step", "--output", again)
        for ending in ("dxf", "svg", "step"):
            self.assertEqual((again / f"turned.{ending}").read_bytes(), (self.folder / f"turned.{ending}").read_bytes(), ending)

    def test_step_has_a_body_per_layer(self):
        case = temporary / "turned_layers.toml"
        case.write_text(TURNED + """
[[material.layer]]
name = "core"
outer_radius = 0.26
youngs_modulus = 2e9
poissons_ratio = 0.3
[[material.layer]]
name = "tyre"
inner_radius = 0.31
youngs_modulus = 30e6
poissons_ratio = 0.3
""")
        folder = temporary / "turned_layers"
        wheelwright("export", case, "--format", "step,dxf", "--by-layer", "--output", folder)
        facts, _ = self.read_step(folder / "turned_layers.step")
        self.assertEqual(facts["valid"], "1")
        self.assertEqual([name for *_, name in facts["bodies"]], ["core", "material", "tyre"])
        for valid, *_, name in facts["bodies"]:
            self.assertEqual(valid, "1", name)
        whole = float(self.read_step(self.folder / "turned.step")[0]["volume"])
        self.assertAlmostEqual(sum(float(body[1]) for body in facts["bodies"]), whole, delta=2e-4 * whole)
        self.assertEqual({entity.dxf.layer for entity in ezdxf.readfile(folder / "turned_layers.dxf").modelspace()},
                         {"core", "material", "tyre", "AXLE"})
        self.assertTrue((folder / "turned_layers-tyre.step").exists())

    def test_a_groove_ends_at_a_solid_layer_without_a_skin(self):
        case, folder = temporary / "turned_band.toml", temporary / "turned_band"
        case.write_text(TURNED + """
[[material.layer]]
name = "band"
inner_radius = 0.305
outer_radius = 0.32
holes = "none"
youngs_modulus = 2e9
poissons_ratio = 0.3
""")
        wheelwright("export", case, "--format", "step", "--output", folder)
        facts, _ = self.read_step(folder / "turned_band.step")
        self.assertEqual([(valid, solids, name) for valid, _, solids, _, name in facts["bodies"]],
                         [("1", "1", "material"), ("1", "1", "band"), ("1", "1", "material 2")])


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = temporary / "command.toml"
        cls.case.write_text(PAPER.replace("iterations = 12", "iterations = 1"))
        cls.run_folder = temporary / "command"
        wheelwright("run", cls.case, "--output", cls.run_folder, "--threads", 1)

    def fresh(self):
        return Path(tempfile.mkdtemp(dir=temporary))

    def test_report(self):
        told = wheelwright("export", self.case, "--output", self.fresh())
        self.assertRegex(told, r"curves +18 loops: 18 arcs")
        # The walls between holes of radius 40 on a circle of radius 270, and the holes.
        self.assertRegex(told, r"smallest wall +25\.35 mm at azimuth \d*2\.50 deg, radius 264\.8 mm")
        self.assertRegex(told, r"smallest gap +80\.00 mm at azimuth 11\.25 deg, radius 270\.0 mm")
        self.assertRegex(told, r"roughness +0\.00 turns of an edge below 4\.42 mm")
        self.assertRegex(told, r"internal corner +radius (39\.9|40\.0)\d mm")
        self.assertRegex(told, r"external corner +none")

    def test_an_edge_with_teeth_is_warned_of_unless_it_was_drawn(self):
        # Two teeth of material, 1 cm high and wide, reach into every hole.
        comb = ("[[shape.polygon]]\ncount = 16\npoints = [[0.24, -0.02], [0.3, -0.02], [0.3, 0.02], [0.28, 0.02], "
                "[0.275, 0.01], [0.27, 0.02], [0.26, 0.02], [0.255, 0.01], [0.25, 0.02], [0.24, 0.02]]\n")
        drawn, saved = self.fresh() / "drawn.toml", self.fresh() / "saved.toml"
        settings = PAPER[PAPER.index("[grid]"):].replace("iterations = 12", "iterations = 0")
        drawn.write_text(comb + settings)
        run_folder = self.fresh() / "run"
        wheelwright("run", drawn, "--output", run_folder, "--threads", 1)
        saved.write_text(f'[shape]\nfrom = "{run_folder}"\n' + settings)
        told = wheelwright("export", saved, "--output", self.fresh())
        turns = float(re.search(r"roughness +([\d.]+) turns", told)[1])
        self.assertGreater(turns, 1.5)
        warning = re.search(rf"warning: an edge makes {turns:.2f} turns .* at (azimuth .*, radius .* mm): .*level_set_degree", told)
        self.assertIn(f"a cell, at {warning[1]}\n", told)
        self.assertNotIn("an edge makes", wheelwright("export", drawn, "--output", self.fresh()))
        self.assertNotIn("an edge makes", wheelwright("export", run_folder, "--output", self.fresh()))

    def test_files_go_to_the_current_folder_unless_told_otherwise(self):
        folder = self.fresh()
        wheelwright("export", self.run_folder, cwd=folder)
        self.assertEqual(sorted(os.listdir(folder)), ["command.dxf", "command.stl", "command.svg"])

    def test_tolerance_decides_how_many_cubics_there_are(self):
        def cubics(tolerance):
            told = wheelwright("export", self.run_folder, "--tolerance", tolerance, "--format", "dxf", "--output", self.fresh())
            return int(re.search(r"(\d+) cubics", told)[1])
        self.assertGreater(cubics(0.002), cubics(0.05))

    def test_wrong_arguments(self):
        for arguments in (["--format", "dwg"], ["--format", "dxf,"], ["--format", ""], ["--tolerance", "0"],
                          ["--tolerance", "nan"], ["--tolerance", "-1"], ["--tolerance", "0.01mm"], ["--tolerance", "5000"]):
            folder = self.fresh()
            wheelwright("export", self.run_folder, *arguments, "--output", folder, code=2)
            self.assertEqual(os.listdir(folder), [])

    def test_a_folder_without_a_run_or_a_checkpoint(self):
        self.assertIn("contains no run", wheelwright("export", self.fresh(), code=2))
        self.assertIn("cannot be read", wheelwright("export", self.fresh() / "none.toml", code=2))
        folder = self.fresh()
        (folder / "case.toml").write_bytes((self.run_folder / "case.toml").read_bytes())
        self.assertIn("no usable checkpoint", wheelwright("export", folder, code=6))

    def test_nothing_is_overwritten_without_force(self):
        folder = self.fresh()
        (folder / "command.svg").write_text("mine")
        told = wheelwright("export", self.run_folder, "--output", folder, code=4)
        self.assertIn("command.svg: exists already", told)
        self.assertEqual(os.listdir(folder), ["command.svg"])
        self.assertEqual((folder / "command.svg").read_text(), "mine")
        wheelwright("export", self.run_folder, "--output", folder, "--force")
        self.assertIn("<svg", (folder / "command.svg").read_text())

    def test_output_that_cannot_be_written(self):
        file = self.fresh() / "file"
        file.write_text("")
        self.assertIn("cannot write", wheelwright("export", self.run_folder, "--output", file / "folder", code=5))

    def test_the_runs_folder_is_left_as_it_is(self):
        def state():
            return {path: (path.stat().st_mtime_ns, hashlib.md5(path.read_bytes()).hexdigest() if path.is_file() else None)
                    for path in [self.run_folder, *self.run_folder.rglob("*")]}
        before = state()
        wheelwright("export", self.run_folder, "--output", self.fresh())
        self.assertEqual(state(), before)

    def test_other_commands_do_not_load_the_large_libraries(self):
        for arguments in (["--version"], ["export", self.case, "--output", self.fresh()]):
            told = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=True,
                                  env={**os.environ, "LD_DEBUG": "files"}).stderr
            self.assertIn("libwheelwright", told)
            self.assertNotRegex(told, "libTK|lib3MF")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        temporary = Path(name)
        unittest.main(verbosity=2)
