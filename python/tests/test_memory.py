"""Memory after many evaluations, failures, and exceptions from own functions."""

import unittest

import numpy as np

import wheelwright as ww
from wheels import PressureSquared, small

N, WARM_UP = 1000, 100


def resident():
    """The resident memory of this process [kB]."""
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))


class Broken(PressureSquared):
    def evaluate(self, state):
        raise ArithmeticError


class SlowMemory(unittest.TestCase):
    def check(self, once):
        for _ in range(WARM_UP):
            once()
        before = resident()
        for _ in range(N):
            once()
        growth = resident() / before - 1
        print(f"{self._testMethodName}: {100 * growth:+.2f} %")
        self.assertLess(growth, 0.05)

    def test_evaluations(self):
        study = ww.Study(small([PressureSquared()]).bound("pressure_squared", at_most=1e15))

        def once():
            evaluation = study.evaluate()
            np.asarray(evaluation["objective"].gradient.density).sum()
            evaluation.state.displacement(0)

        self.check(once)

    def test_failures(self):
        study = ww.Study(small())
        gone = study.shape.moved(np.ones_like(study.shape.values))

        def once():
            with self.assertRaises(ww.ComputationError):
                study.evaluate(gone)

        self.check(once)

    def test_exceptions(self):
        study = ww.Study(small([Broken()]).bound("pressure_squared", at_most=1e15))

        def once():
            with self.assertRaises(ArithmeticError):
                study.evaluate()

        self.check(once)


if __name__ == "__main__":
    unittest.main()
