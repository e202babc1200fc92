"""What Python costs: medians of five interleaved runs of Python and C++, on one thread.

usage: overhead.py EVALUATIONS CASE, with the program `evaluations` of bench/ and cases/holes16.toml
"""

import statistics
import subprocess
import sys
import time

import numpy as np

import wheelwright as ww

ROUNDS, REPETITIONS = 5, 11


class FourthPower(ww.MaterialDensity):
    """The fourth power of the von Mises stress in plane strain, in numpy [MPa^4]."""

    name, unit = "fourth_power", "MPa^4 m^2"

    @staticmethod
    def form(material):
        """Q with the squared von Mises stress e.Q e."""
        _, mu = material.lame
        q = np.array([[1, -0.5, 0], [-0.5, 1, 0], [0, 0, 0.75]])
        return q * (2 * mu / 1e6) ** 2

    def squares(self, strains, material):
        (a, b, _), _, (_, _, c) = self.form(material)
        x, y, xy = (strains[..., k] for k in range(3))
        return a * (x * x + y * y) + 2 * b * (x * y) + c * (xy * xy)

    def values(self, strains, material):
        return self.squares(strains, material) ** 2

    def slopes(self, strains, material):
        (a, b, _), _, (_, _, c) = self.form(material)
        x, y, xy = (strains[..., k] for k in range(3))
        factor = 4 * self.squares(strains, material)
        slopes = np.empty_like(strains)
        slopes[..., 0] = factor * (a * x + b * y)
        slopes[..., 1] = factor * (b * x + a * y)
        slopes[..., 2] = factor * (c * xy)
        return slopes


def seconds_in_python(case):
    """The median of evaluations in this process."""
    study = ww.Study(case)
    times = []
    for _ in range(REPETITIONS):
        begin = time.perf_counter()
        study.evaluate()
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


def seconds_in_cpp(program, file, functional, keys):
    """The median that the program prints."""
    settings = [f"{key}={value}" for key, value in keys.items()]
    done = subprocess.run(
        [program, file, str(REPETITIONS), functional, *settings], capture_output=True, text=True, check=True
    )
    return float(done.stdout)


def compare(what, program, file, functional, keys):
    """Prints the medians of the rounds, and their ratio."""
    case = ww.Case(file, [FourthPower()]).replace(keys)
    if functional != "none":
        bounded = {"optimizer.method": "sequential_quadratic"}
        case = case.replace(bounded).bound(functional, at_most=1e15)
    ours, theirs = [], []
    for _ in range(ROUNDS):
        theirs.append(seconds_in_cpp(program, file, functional, keys))
        ours.append(seconds_in_python(case))
    ours, theirs = statistics.median(ours), statistics.median(theirs)
    print(f"{what}: Python {ours * 1e3:.1f} ms, C++ {theirs * 1e3:.1f} ms, ratio {ours / theirs:.3f}")


if __name__ == "__main__":
    with ww.limit_threads(1):
        bands = {"optimizer.rim_band": 0.02, "optimizer.tread_band": 0.02}
        coarse = {"grid.radial_cells": 14, "grid.angular_cells": 192}
        compare("evaluation, 14 x 192 cells", *sys.argv[1:3], "none", coarse | bands)
        fine = {"grid.radial_cells": 28, "grid.angular_cells": 384, "load.positions": 8}
        compare("fourth power, 28 x 384 cells", *sys.argv[1:3], "fourth_power", fine)
