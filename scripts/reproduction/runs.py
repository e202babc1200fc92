"""Runs cases with the built program and reads what it wrote."""

import csv
import math
import re
import shutil
import subprocess
import time
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from .vtu import read_array

cases = Path("cases/paper")
runs = Path("runs/reproduction")


@dataclass
class Hole:
    length: float  # radial extent [mm]
    width: float  # azimuthal extent at mid-length [mm]
    outer_radius: float  # farthest from the axle [mm]

    def resembles(self, other: "Hole") -> bool:
        return abs(self.length - other.length) < 0.5 and abs(self.outer_radius - other.outer_radius) < 0.5


@dataclass
class Run:
    """A run of cases/paper/NAME.toml. `failure` is the program's last line if it gave up."""

    name: str
    folder: Path
    seconds: float
    failure: str | None = None

    @cached_property
    def history(self) -> list[dict[str, float]]:
        """The accepted shapes; keys are the columns without their units."""
        with open(self.folder / "history.csv") as file:
            rows = [row for row in csv.DictReader(file) if row["accepted"] == "1"]
        return [{k.split(" [")[0]: _number(v) for k, v in row.items()} for row in rows]

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

    def peak_spread(self, shape: str) -> float:
        """(largest - smallest) / mean of the peak pressures of the load positions."""
        peaks = [max(p["pressure"] for p in points) for points in self.pressures(shape)]
        return (max(peaks) - min(peaks)) / (sum(peaks) / len(peaks))

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
        for file in sorted((self.folder / "rolling").glob("*.vtu")):
            points, stress = read_array(file, None), read_array(file, "von_mises")
            for k, value in enumerate(stress):
                if value > largest and math.hypot(points[3 * k], points[3 * k + 1]) < 0.315:
                    largest = value
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
            hole = _measure(list(zip(numbers[::2], numbers[1::2])))
            if not any(hole.resembles(kind) for kind in kinds):
                kinds.append(hole)
        return sorted(kinds, key=lambda hole: hole.outer_radius)


def execute(program: str, name: str, progress: str) -> Run:
    folder = runs / name
    shutil.rmtree(folder, ignore_errors=True)
    print(f"{progress} {cases / name}.toml", flush=True)
    start = time.monotonic()
    result = subprocess.run(
        [program, "run", str(cases / f"{name}.toml"), "--output", str(folder)], capture_output=True, text=True
    )
    run = Run(name, folder, time.monotonic() - start)
    if result.returncode != 0:
        run.failure = result.stderr.strip().splitlines()[-1].removeprefix("wheelwright run: ")
    return run


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


def _measure(points: list[tuple[float, float]]) -> Hole:
    radii = [math.hypot(x, y) for x, y in points]
    start = math.atan2(points[0][1], points[0][0])
    angles = [math.remainder(math.atan2(y, x) - start, 2 * math.pi) for x, y in points]
    middle = (min(radii) + max(radii)) / 2
    return Hole(max(radii) - min(radii), (max(angles) - min(angles)) * middle, max(radii))
