"""Reads what runs of the program wrote."""

import csv
import math
import re
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path

from .hole import Hole, measured
from .vtu import read_array, read_polygons

shear_modulus = 200e6 / 2 / 1.48  # of the paper's material [Pa]


@dataclass(eq=False)
class Run:
    """A run of a case. `failure` is the program's last line if it gave up, `unmet` are its lines
    about values that are not as the case expects, `expected` how many values it expects."""

    name: str
    folder: Path
    seconds: float  # of processor time
    failure: str | None = None
    unmet: list[str] = field(default_factory=list)
    expected: int = 0

    @cached_property
    def _trials(self) -> list[dict[str, str]]:
        with open(self.folder / "history.csv") as file:
            return list(csv.DictReader(file))

    @cached_property
    def history(self) -> list[dict[str, float]]:
        """The accepted shapes; keys are the columns without their units."""
        rows = [row for row in self._trials if row["accepted"] == "1"]
        return [{k.split(" [")[0]: _number(v) for k, v in row.items()} for row in rows]

    @property
    def end(self) -> str:
        """Why the last trial shape was rejected; empty if it was accepted."""
        return self._trials[-1]["reason"]

    @property
    def first(self) -> dict[str, float]:
        return self.history[0]

    @property
    def last(self) -> dict[str, float]:
        return self.history[-1]

    def column(self, name: str) -> list[float]:
        return [row[name] for row in self.history]

    def change(self, name: str) -> float:
        """Relative change from the first shape to the last."""
        return self.last[name] / self.first[name] - 1

    def pressures(self, shape: str) -> list[list[dict[str, float]]]:
        """The points of each load position; shape is "initial" or "final"."""
        positions: dict[float, list] = {}
        with open(self.folder / f"pressures_{shape}.csv") as file:
            for row in csv.DictReader(file):
                point = {k.split(" [")[0]: float(v) for k, v in row.items()}
                positions.setdefault(point["position"], []).append(point)
        return list(positions.values())

    @cache
    def peak_spread(self, shape: str) -> float:
        """(largest - smallest) / mean of the peak pressures of the load positions."""
        peaks = [max(p["pressure"] for p in points) for points in self.pressures(shape)]
        return (max(peaks) - min(peaks)) / (sum(peaks) / len(peaks))

    @cache
    def curve_deviation(self, shape: str) -> float:
        """Root mean square of pressure minus mean pressure at the same place of the ground, over that of
        the mean."""
        curves = [[(p["x"], p["pressure"]) for p in points] for points in self.pressures(shape)]
        low, high = min(c[0][0] for c in curves), max(c[-1][0] for c in curves)
        deviation = mean_square = 0.0
        for k in range(401):
            x = low + (high - low) * k / 400
            values = [_interpolate(curve, x) for curve in curves]
            mean = sum(values) / len(values)
            mean_square += mean**2
            deviation += sum((v - mean) ** 2 for v in values) / len(values)
        return math.sqrt(deviation / mean_square)

    def deepest_penetration(self) -> float:
        """Of the final shape, over all load positions [m]."""
        return max(max(-p["gap"], 0.0) for points in self.pressures("final") for p in points)

    def largest_inner_stress(self) -> float:
        """Largest nodal von Mises stress over all load positions, but for the outer 25 mm, where the contact
        itself has the largest [Pa]."""
        largest = 0.0
        for file in sorted((self.folder / "rolling").glob("wheel_*.vtu")):
            points, stress = read_array(file, "Points"), read_array(file, "von_mises_Pa")
            for k, value in enumerate(stress):
                if value > largest and math.hypot(points[3 * k], points[3 * k + 1]) < 0.315:
                    largest = value
        return largest

    @cached_property
    def stress_near_holes(self) -> list[float]:
        """Von Mises stress of the material in every piece of a cut cell near the contact [Pa], the largest of all
        positions, in an order that depends on shape and grid alone. It is that of the piece's displacements, so that
        nothing outside the material takes part."""
        largest: list[float] = []
        for file in sorted((self.folder / "rolling").glob("wheel_*.vtu")):
            points, moves = read_array(file, "Points"), read_array(file, "displacement_m")
            if not largest:
                pieces = [p for p in read_polygons(file) if _is_small_and_near(p, points)]
                largest = [0.0] * len(pieces)
            for k, piece in enumerate(pieces):
                largest[k] = max(largest[k], _von_mises(piece, points, moves))
        return largest

    @cached_property
    def holes(self) -> list[Hole]:
        """The holes of the final shape one of each kind."""
        path = re.search(r' d="([^"]*)"', (self.folder / "shape.svg").read_text()).group(1)
        kinds: list[Hole] = []
        for contour in path.split("Z"):
            if "A" in contour or "L" not in contour:
                continue
            numbers = [float(n) for n in re.findall(r"-?\d+\.?\d*", contour)]
            hole = measured(list(zip(numbers[::2], numbers[1::2])))
            if not any(hole.resembles(kind) for kind in kinds):
                kinds.append(hole)
        return sorted(kinds, key=lambda hole: hole.outer_radius)


def _is_small_and_near(piece: list[int], points: list[float]) -> bool:
    """Whether a piece is of a cut cell, within about one sector and a half of the load positions."""
    corners = [(points[3 * k], points[3 * k + 1]) for k in piece]
    across = max(math.dist(a, b) for a in corners for b in corners)
    return 1e-5 < across < 2.6e-3 and abs(math.atan2(corners[0][1], corners[0][0]) - 0.2) < 0.6


def _von_mises(piece: list[int], points: list[float], moves: list[float]) -> float:
    """Of the linear displacement that fits a piece best, for the paper's material in plane strain."""
    n = len(piece)
    x, y, u, v = (sum(a[3 * k + c] for k in piece) / n for a in (points, moves) for c in (0, 1))
    xx = xy = yy = ux = uy = vx = vy = 0.0
    for k in piece:
        dx, dy, du, dv = points[3 * k] - x, points[3 * k + 1] - y, moves[3 * k] - u, moves[3 * k + 1] - v
        xx, xy, yy = xx + dx * dx, xy + dx * dy, yy + dy * dy
        ux, uy, vx, vy = ux + du * dx, uy + du * dy, vx + dv * dx, vy + dv * dy
    determinant = xx * yy - xy * xy
    if determinant < 1e-6 * (xx + yy) ** 2:  # too thin for a gradient
        return 0.0
    exx, exy = (ux * yy - uy * xy) / determinant, (uy * xx - ux * xy) / determinant
    eyx, eyy = (vx * yy - vy * xy) / determinant, (vy * xx - vx * xy) / determinant
    shear = exy + eyx
    squared_deviator = exx**2 + eyy**2 + 0.5 * shear**2 - (exx + eyy) ** 2 / 3
    return shear_modulus * math.sqrt(6 * squared_deviator)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _interpolate(curve: list[tuple[float, float]], x: float) -> float:
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if x0 <= x <= x1 and x1 > x0:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return 0.0
