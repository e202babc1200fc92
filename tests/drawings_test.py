"""DXF files that ezdxf writes, through the program: the outline of the wheel is that of ezdxf's own curves.

usage: drawings_test.py PROGRAM
"""

import math
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import ezdxf
    from ezdxf import disassemble, path as ezdxf_path
except ImportError:
    print("not installed: python3-ezdxf")
    sys.exit(77)

program = sys.argv.pop(1)

CASE = """
[wheel]
sectors = 1
[load]
positions = 1
[[shape.file]]
path = "holes.dxf"
[grid]
tread_levels = 0
[optimizer]
iterations = 0
"""


def drawing(version, units):
    """Holes of every kind, anywhere on a wheel without symmetry; lengths in the unit of `units` [m]."""
    document = ezdxf.new(version)
    document.units = units[0]
    space = document.modelspace()
    u = 1 / units[1]

    def at(radius, degrees):
        return (radius * math.cos(math.radians(degrees)) * u, radius * math.sin(math.radians(degrees)) * u)

    space.add_circle(at(0.27, 10), 0.03 * u)
    space.add_ellipse(at(0.27, 50), major_axis=(0.03 * u, 0.02 * u), ratio=0.5)
    x, y = at(0.26, 90)
    space.add_lwpolyline([(x - 0.02 * u, y, 0.4), (x + 0.03 * u, y, 0), (x + 0.02 * u, y + 0.03 * u, -0.3),
                          (x - 0.02 * u, y + 0.03 * u, 0)], format="xyb", close=True)
    x, y = at(0.27, 140)
    space.add_arc((x, y), 0.03 * u, 30, 250)
    ends = [(x + 0.03 * u * math.cos(math.radians(a)), y + 0.03 * u * math.sin(math.radians(a))) for a in (250, 30)]
    space.add_line(ends[1], ends[0])
    x, y = at(0.27, 200)
    space.add_open_spline([(x, y), (x + 0.04 * u, y), (x + 0.05 * u, y + 0.04 * u), (x - 0.01 * u, y + 0.05 * u),
                           (x - 0.03 * u, y + 0.02 * u)], degree=3)
    space.add_line((x - 0.03 * u, y + 0.02 * u), (x, y))
    block = document.blocks.new("kite")
    block.add_polyline2d([(0, 0), (0.03 * u, 0.01 * u), (0.04 * u, 0.03 * u), (0.01 * u, 0.02 * u)], close=True)
    space.add_blockref("kite", at(0.25, 300), dxfattribs={"xscale": 1.3, "yscale": -0.9, "rotation": 25})
    return document


def reference(document, metre):
    """Points on the curves, by ezdxf [m]."""
    points = []
    for entity in disassemble.recursive_decompose(document.modelspace()):
        flat = list(ezdxf_path.make_path(entity).flattening(1e-5 / metre, segments=64))
        points += [(v.x * metre, v.y * metre) for v in flat]
    return points


def outline(svg):
    """The polygons of the holes in shape.svg [m], y upwards."""
    data = re.search(r' d="([^"]*)"', svg).group(1)
    polygons = []
    for part in data.split("Z"):
        if "A" in part:
            continue
        numbers = [float(n) for n in re.findall(r"-?\d+\.?\d*", part)]
        if numbers:
            polygons.append([(x / 1000, -y / 1000) for x, y in zip(numbers[::2], numbers[1::2])])
    return polygons


def distance_to(polygons, x, y):
    nearest = math.inf
    for polygon in polygons:
        for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
            dx, dy = bx - ax, by - ay
            length = dx * dx + dy * dy
            s = min(max(((x - ax) * dx + (y - ay) * dy) / length, 0), 1) if length else 0
            nearest = min(nearest, math.hypot(ax + s * dx - x, ay + s * dy - y))
    return nearest


class Dxf(unittest.TestCase):
    def check(self, version, units):
        document = drawing(version, units)
        with tempfile.TemporaryDirectory() as folder:
            document.saveas(Path(folder) / "holes.dxf")
            (Path(folder) / "case.toml").write_text(CASE)
            subprocess.run([program, "run", "case.toml", "--output", "run"], cwd=folder, check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            polygons = outline((Path(folder) / "run/shape.svg").read_text())
        # A sharp corner may leave a speck of its own.
        self.assertEqual(len([p for p in polygons if len(p) > 20]), 6)
        distances = sorted(distance_to(polygons, x, y) for x, y in reference(document, units[1]))
        # The level set is quadratic on cells of 5 mm: smooth edges are exact to 0.03 mm, corners are rounded.
        self.assertLess(distances[len(distances) * 9 // 10], 3e-5)
        self.assertLess(distances[-1], 3e-3)

    def test_in_millimetres(self):
        self.check("R2010", (4, 1e-3))

    def test_in_inches(self):
        self.check("R2000", (1, 0.0254))


if __name__ == "__main__":
    unittest.main()
