"""Takes random wheels in 3D from their case to files for CAD: check, a run of two shapes, STL and STEP.

They are made in all ways, with and without friction, camber, lateral and horizontal forces, with free and with fixed side
faces, of one or two materials, under one or several loads. Each ends well, or is refused with the key or the reason: what
ends well has finite numbers, a surface without gaps that has the volume of the summary, no undercut if it is moulded, no
steeper overhang than allowed if it is printed, and one valid solid if it has a STEP file.
Of NUMBER + 6 wheels the last six are printed.
usage: random_solid_wheels_test.py PROGRAM READ_STEP NUMBER SEED
"""

import collections
import json
import math
import random
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
import support

program, read_step, number, seed = sys.argv[1:5]
del sys.argv[1:5]

DONE, ERRORS, GAVE_UP, REFUSED, INFEASIBLE = 0, 2, 3, 4, 9  # exit codes
MADE = ["free", "extruded", "turned", "moulded"]
PRINTED = 6


class Draw(random.Random):

    def chance(self, probability):
        return self.random() < probability

    def log_uniform(self, a, b):
        return math.exp(self.uniform(math.log(a), math.log(b)))


class Wheel:
    """A case on a small grid, with thick bands."""

    def __init__(self, draw, made):
        self.draw, self.made = draw, made
        self.outer = draw.log_uniform(0.03, 0.5)
        self.inner = self.outer * draw.uniform(0.35, 0.7)
        self.width = self.outer * draw.log_uniform(0.1, 0.7)
        self.rows, self.layers = draw.randint(7, 9), draw.randint(2, 4)
        self.cell = (self.outer - self.inner) / self.rows
        self.sectors = draw.choice([6, 8, 12, 16])
        self.modulus, self.friction = draw.log_uniform(2e6, 5e9), draw.choice([0, draw.uniform(0.1, 1)])
        self.force = math.pi / 4 * self.modulus * self.outer * 4e-4 * self.width * draw.log_uniform(0.1, 5)
        self.faces = draw.choice(["free", "free", "symmetric"])
        # Those that fix the wheel along the axle are mostly not asked to lean.
        self.leans = self.faces == "free" or draw.chance(0.1)
        self.ratio = draw.choice([0.2, 0.3, 0.45, 0.49])
        # Between the bands.
        self.low, self.high = self.inner + 1.1 * self.cell, self.outer - 2.1 * self.cell

    def text(self):
        return "\n".join([self.wheel(), self.material(), self.load(), self.holes(), self.grid(), self.optimizer()])

    def wheel(self):
        sectors = "" if self.made == "turned" else f"sectors = {self.sectors}"
        return f"""[wheel]
dimension = 3
outer_radius = {self.outer}
inner_radius = {self.inner}
width = {self.width}
side_faces = "{self.faces}"
{sectors}"""

    def material(self):
        text = f"""[material]
youngs_modulus = {self.modulus}
poissons_ratio = {self.ratio}"""
        if self.draw.chance(0.2):
            text += f"""
[[material.layer]]
name = "core"
outer_radius = {self.inner + 3 * self.cell}
youngs_modulus = {self.modulus * self.draw.log_uniform(0.3, 30)}
poissons_ratio = 0.3"""
        return text

    def load(self):
        draw, held = self.draw, self.friction * self.force
        text = f"[contact]\nfriction = {self.friction}\n[load]\nforce = {self.force}\n"
        if self.made != "turned":
            text += f"positions = {draw.randint(1, 2)}\n"
        if self.leans and draw.chance(0.4):
            text += f"camber = {draw.uniform(-6, 6)}\n"
        if held and draw.chance(0.5):
            kinds = ["lateral_force", "horizontal_force"] if self.leans else ["horizontal_force"]
            text += f"{draw.choice(kinds)} = {held * draw.uniform(-0.8, 0.8)}\n"
        if draw.chance(0.3):
            text += f'[[load.case]]\nname = "usual"\n[[load.case]]\nname = "heavy"\nforce = {self.force * draw.uniform(1, 3)}\n'
            if held and draw.chance(0.5):
                text += f"torque = {held * self.outer * draw.uniform(-0.7, 0.7)}\n"
        return text

    def place(self, count):
        """A radius between the bands, and the room for holes there."""
        radius = self.draw.uniform(0.6 * self.low + 0.4 * self.high, 0.4 * self.low + 0.6 * self.high)
        return radius, min(radius - self.low, self.high - radius, radius * math.sin(math.pi / count))

    def holes(self):
        kinds = ["ring"] if self.made == "extruded" else ["ring", "sphere", "tapered", "groove"]
        if self.made == "turned":
            kinds = ["groove"]
        return "\n".join(getattr(self, self.draw.choice(kinds))() for _ in range(self.draw.choice([1, 1, 2])))

    def ring(self):
        radius, room = self.place(self.sectors)
        return f"""[[holes.ring]]
count = {self.sectors}
center_radius = {radius}
radius = {room * self.draw.uniform(0.4, 0.95)}
phase = {self.draw.choice([0, self.draw.uniform(-10, 10)])}"""

    def sphere(self):
        radius, room = self.place(self.sectors)
        return f"""[[holes.sphere]]
count = {self.sectors}
center_radius = {radius}
radius = {room * self.draw.uniform(0.6, 1)}
z = {self.width * self.draw.uniform(-0.5, 0.5)}"""

    def tapered(self):
        radius, room = self.place(self.sectors)
        ends = [room * self.draw.uniform(0.3, 1) for _ in range(3)]
        return f"""[[holes.tapered]]
count = {self.sectors}
center_radius = {radius}
profile = [[{-self.width / 2}, {ends[0]}], [{0.1 * self.width}, {ends[1]}], [{self.width / 2}, {ends[2]}]]"""

    def groove(self):
        middle, half = (self.low + self.high) / 2, (self.high - self.low) / 2 * self.draw.uniform(0.6, 1)
        return f"""[[holes.groove]]
inner_radius = {middle - half}
outer_radius = {middle + half}
depth = {self.width * self.draw.uniform(0.1, 0.4)}
side = "{self.draw.choice(['both', 'both', 'smaller_z', 'larger_z'])}\""""

    def grid(self):
        columns = "" if self.made == "turned" else f"angular_cells = {self.sectors * (48 // self.sectors + 1)}\n"
        return f"""[grid]
radial_cells = {self.rows}
{columns}axial_cells = {self.layers}
degree = {self.draw.randint(1, 2) if self.ratio < 0.4 else 2}
tread_levels = {self.draw.randint(0, 1)}"""

    def optimizer(self):
        draw = self.draw
        text = f"""[optimizer]
iterations = 2
made = "{self.made}"
rim_band = {1.05 * self.cell}
tread_band = {2.05 * self.cell}
"""
        if self.made == "moulded":
            text += f"draft = {draw.choice([0, 2, draw.uniform(0, 10)])}\n"
            if draw.chance(0.6):
                text += f"parting_plane = {draw.randint(0, self.layers) * self.width / self.layers!r}\n"
        if self.made == "printed":
            text += f"overhang = {draw.choice([0, 45, draw.uniform(0, 75)])}\n"
            text += f'stands_on = "{draw.choice(["smaller_z", "larger_z"])}"\n'
        if draw.chance(0.3):
            text += f"[volume]\ntarget = {draw.uniform(0.7, 0.95)}\n"
        if draw.chance(0.2):
            text += f'[[constraint]]\nquantity = "stiffness"\nat_least = {draw.log_uniform(0.01, 3) * self.modulus * self.width}\n'
        return text + '[output]\nerrors = "none"\n'


def run(*arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False, timeout=600,
                          env=support.one_thread_each())


def numbered(first, second):
    """The same number for equal pairs: numpy sorts whole numbers faster than rows."""
    return numpy.unique(first << numpy.uint64(32) | second, return_inverse=True)[1].astype(numpy.uint64)


def volume_of_closed_surface(path):
    """[m^3]; nothing if an edge does not belong to two triangles of opposite direction."""
    triangle = numpy.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    corners = numpy.fromfile(path, triangle, offset=84)["corners"]
    without_signs_of_zero = numpy.ascontiguousarray(corners + numpy.float32(0))
    bits = without_signs_of_zero.view("<u4").reshape(-1, 3).astype(numpy.uint64)
    points = numbered(numbered(bits[:, 0], bits[:, 1]), bits[:, 2]).reshape(-1, 3)
    begins, ends = points.ravel(), numpy.roll(points, -1, axis=1).ravel()
    count = points.max() + numpy.uint64(1)
    edges, reverse = numpy.sort(begins * count + ends), numpy.sort(ends * count + begins)
    if (edges[1:] == edges[:-1]).any() or (edges != reverse).any():
        return None
    a, b, c = numpy.moveaxis(corners.astype(float), 1, 0)
    return 1e-9 * (a * numpy.cross(b, c)).sum() / 6


def numbers_in(value, path=""):
    """All numbers of a JSON value and whether each is finite: json reads NaN and Infinity."""
    if isinstance(value, dict):
        for key, one in value.items():
            yield from numbers_in(one, f"{path}.{key}")
    elif isinstance(value, list):
        for k, one in enumerate(value):
            yield from numbers_in(one, f"{path}[{k}]")
    elif isinstance(value, float):
        yield path, value


class RandomSolidWheels(unittest.TestCase):

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.ends = collections.Counter()

    def test_each_ends_well_or_is_refused_with_a_reason(self):
        draw = Draw(int(seed))
        for k in range(int(number) + PRINTED):
            wheel = Wheel(draw, MADE[k % len(MADE)] if k < int(number) else "printed")
            text = wheel.text()
            with self.subTest(wheel=k, case=text):
                case = self.folder / f"wheel{k}.toml"
                case.write_text(text, encoding="utf-8")
                end = self.end_of(wheel, case)
                self.ends[end] += 1
                print(k, wheel.made, end, flush=True)
        print(", ".join(f"{many} {end}" for end, many in sorted(self.ends.items())))
        self.assertGreaterEqual(self.ends["done"], 0.5 * int(number))

    def end_of(self, wheel, case):
        """How a case ends, in a few words."""
        checked = run("check", case, "--json")
        self.assertIn(checked.returncode, (DONE, ERRORS), checked.stderr)
        problems = json.loads(checked.stdout)["problems"]
        if checked.returncode == ERRORS:
            for problem in problems:
                self.assertTrue(problem["key"] or problem["problem"], problem)
            return "refused: " + (problems[0]["key"] or problems[0]["problem"])
        results = case.with_suffix("")
        ended = run("run", case, "--output", results)
        self.assertIn(ended.returncode, (DONE, GAVE_UP, INFEASIBLE), ended.stderr)
        summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
        for path, value in numbers_in(summary):
            self.assertTrue(math.isfinite(value), path)
        if "failure" in summary:
            self.assertTrue(summary["failure"]["reason"] and summary["failure"]["detail"])
            return "failed: " + summary["failure"]["reason"]
        self.check_shape(wheel, results, summary)
        for kind in ("stl", "step"):
            if refusal := self.refusal_of_export(wheel, results, kind):
                return f"{kind} refused: {refusal}"
        return "done" if ended.returncode == DONE else "gave up" if ended.returncode == GAVE_UP else "bound not kept"

    def check_shape(self, wheel, results, summary):
        ring = math.pi * (wheel.outer**2 - wheel.inner**2) * wheel.width
        self.assertEqual(summary["made"]["how"], wheel.made)
        told = summary["after"]["volume_fraction"] * ring
        surface = volume_of_closed_surface(results / "shape.stl")
        self.assertIsNotNone(surface, "shape.stl has gaps")
        # The cells' edges are chords and parabolas of the circles, and the triangles' edges chords.
        self.assertAlmostEqual(surface, told, delta=0.02 * told)
        draft, overhang = summary["made"].get("smallest_draft"), summary["made"].get("largest_overhang")
        if draft:
            self.assertGreater(math.degrees(draft["angle_rad"]), -0.01)
        if overhang:
            self.assertLess(math.degrees(overhang["angle_rad"] - summary["made"]["overhang_rad"]), 5)

    def refusal_of_export(self, wheel, results, kind):
        """Returns why no file was written; "" if a valid one was."""
        folder = results / "export"
        # Coarse cells need coarse surfaces; the outlines and profiles of STEP files have the usual tolerance.
        of_outlines = ("extruded", "turned") if kind == "step" else ("extruded",)
        for share in (0.05, 0.02, 0.01):
            tolerance = ("--tolerance", f"{1e3 * share * wheel.cell:.3f}") if wheel.made not in of_outlines else ()
            exported = run("export", results, "--format", kind, "--output", folder, "--force", *tolerance)
            if "decrease --tolerance" not in exported.stderr:
                break
        if exported.returncode == REFUSED:
            self.assertRegex(exported.stderr, r"wheelwright export: .*\nNothing was written", exported.stderr)
            return re.search(r"wheelwright export: (.*)", exported.stderr)[1]
        self.assertEqual(exported.returncode, DONE, exported.stderr)
        file = folder / f"{results.name}.{kind}"
        if kind == "stl":
            self.assertIsNotNone(volume_of_closed_surface(file), "the exported STL file has gaps")
        else:
            self.check_step(file)
        return ""

    def check_step(self, file):
        """It has one valid solid, or a valid one for each material."""
        lines = subprocess.run([read_step, file], input="", capture_output=True, text=True, check=True).stdout.splitlines()
        bodies = [line.split() for line in lines if line.startswith("body ")]
        if bodies:
            self.assertEqual({body[1] for body in bodies}, {"1"}, lines)
        else:
            self.assertIn("valid 1", lines)
            self.assertIn("solids 1", lines)


if __name__ == "__main__":
    unittest.main()
