import gc
import signal
import subprocess
import sys
import tempfile
import unittest
import weakref
from pathlib import Path

import numpy as np

import wheelwright as ww
from wheels import (
    ALL,
    AcrossWidth,
    Edges,
    EnergyVariance,
    FourthPower,
    Observed,
    PressureSquared,
    RimEnergy,
    Shear,
    small,
    uneven,
)

SOLID = {
    "wheel.dimension": 3,
    "grid.axial_cells": 4,
    "contact.friction": 0.3,
}
TWO_LOADS = {
    "load.case[1].name": "straight",
    "load.case[2].name": "heavy",
    "load.case[2].weight": 0.5,
}


class TaylorTests(unittest.TestCase):
    """Every kind of own function, on a wheel without symmetry, with friction."""

    def check(self, case, name, order=1.9):
        test = ww.Study(case).taylor_test(name)
        self.assertNotEqual(test.derivative, 0)
        self.assertGreater(test.order, order, f"{name}: {test}")

    def test_as_bounds(self):
        case = uneven([kind() for kind in ALL])
        for kind in ALL:
            case = case.bound(kind.name, at_most=1e15)
        checks = {check.function: check for check in ww.Study(case).check_gradients()}
        for kind in ALL:
            check = checks[kind.name]
            self.assertTrue(check.passed, check)
            self.assertGreater(check.lowest_order, 1.9)

    def test_as_objectives(self):
        for kind in (PressureSquared, EnergyVariance, FourthPower):
            self.check(uneven([kind()]).minimize(kind.name), "objective")

    def test_as_terms_in_several_load_cases(self):
        case = uneven([PressureSquared(), EnergyVariance()]).replace(TWO_LOADS)
        self.check(case.minimize({"pressure_squared": 1e-9, "energy_variance": 1e-2}), "objective")



class SlowTaylorTests(unittest.TestCase):
    def test_in_3d(self):
        """On 8 x 96 x 4 cells, also of a function that is odd across the width."""
        kinds = (PressureSquared, Observed, RimEnergy, FourthPower, Edges, AcrossWidth)
        case = uneven([kind() for kind in kinds]).replace(SOLID)
        for kind in kinds:
            case = case.bound(kind.name, at_most=1e15)
        study = ww.Study(case)
        step = 4 * study.shape.test_step
        tests = study.taylor_tests(step=step, halvings=2)
        for kind in kinds:
            self.assertGreater(min(tests[kind.name].orders), 1.9, f"{kind.name}: {tests[kind.name]}")


class Values(unittest.TestCase):
    def test_are_those_of_the_class(self):
        study = ww.Study(small([PressureSquared()]).bound("pressure_squared", at_most=1e15))
        evaluation, state = study.evaluate(), study.solve()
        own = [c.weight @ c.pressure**2 for c in state.contacts]
        self.assertAlmostEqual(evaluation["pressure_squared"].value / np.mean(own), 1, places=12)
        self.assertEqual(evaluation["pressure_squared"].unit, "Pa^2 m")

    def test_of_a_density_are_its_integral(self):
        """Against the same power of the library's own quantity: the strain energy of Hooke's law."""

        class Energy(ww.MaterialDensity):
            name, unit = "own_energy", "J/m"

            def values(self, strains, material):
                return material.energy_density(strains)

            def slopes(self, strains, material):
                return material.stress(strains)

        study = ww.Study(small([Energy()]).bound("own_energy", at_most=1e15))
        state, evaluation = study.solve(), study.evaluate()
        energy = np.zeros(state.n_positions)
        for cell in state.cells():
            energy += (cell.material.energy_density(cell.strains) * cell.weights).sum(axis=(1, 2))
        self.assertAlmostEqual(evaluation["own_energy"].value / energy.mean(), 1, places=10)

    def test_of_edges_are_the_length(self):
        class Length(ww.EdgeDensity):
            name, unit = "edge_length", "m"

            def density(self, places):
                return 1, 0

        study = ww.Study(small([Length()]).bound("edge_length", at_most=10))
        evaluation = study.evaluate()
        self.assertAlmostEqual(
            evaluation["edge_length"].value, evaluation["volume"].gradient.weights.sum(), places=12
        )
        self.assertAlmostEqual(evaluation["edge_length"].value, 2 * 2 * np.pi * 0.03, delta=2e-3)

    def test_without_symmetry_solve_all_positions(self):
        def positions(functional):
            case = small([functional]).replace({"load.positions": 4}).bound(functional.name, at_most=1e15)
            return ww.Study(case).evaluate().state.n_positions

        symmetric = PressureSquared()
        symmetric.symmetric_in_azimuth = True
        self.assertEqual((positions(PressureSquared()), positions(symmetric)), (4, 3))


    def test_of_symmetric_wheels_are_those_of_all_positions(self):
        for kind in (EnergyVariance, PressureSquared, FourthPower):
            evaluations = []
            for promise in (False, True):
                functional = kind()
                functional.symmetric_in_azimuth = promise
                case = small([functional]).replace({"load.positions": 6}).bound(kind.name, at_most=1e15)
                evaluations.append(ww.Study(case).evaluate()[kind.name])
            all_positions, representatives = evaluations
            self.assertAlmostEqual(all_positions.value / representatives.value, 1, places=8)
            a, b = (one.nodal_gradient for one in evaluations)
            np.testing.assert_allclose(a, b, atol=1e-5 * np.abs(a).max())

    def test_of_symmetric_widths_are_those_of_the_whole_width(self):
        values = []
        for promise in (False, True):
            functional = PressureSquared()
            functional.symmetric_across_width = promise
            case = small([functional]).replace({"wheel.dimension": 3, "grid.axial_cells": 2})
            evaluated = ww.Study(case.bound(functional.name, at_most=1e15)).evaluate()[functional.name]
            values.append((evaluated.value, np.abs(evaluated.nodal_gradient).sum()))
        np.testing.assert_allclose(values[0], values[1], rtol=1e-6)


class Mistakes(unittest.TestCase):
    def evaluate(self, functional):
        return ww.Study(small([functional]).bound(functional.name, at_most=1e15)).evaluate()

    def test_in_shapes_say_what_was_expected(self):
        class Wrong(PressureSquared):
            def evaluate(self, state):
                return ww.ByPosition([1.0])

        with self.assertRaisesRegex(ValueError, r"pressure_squared: values .*\(1,\); expected \(2,\)"):
            self.evaluate(Wrong())

        class WrongSlope(FourthPower):
            def slopes(self, strains, material):
                return strains[..., :1]

        with self.assertRaisesRegex(ValueError, "slopes"):
            self.evaluate(WrongSlope())

    def test_exceptions_arrive_unchanged(self):
        error = ZeroDivisionError("own")

        class Broken(PressureSquared):
            def evaluate(self, state):
                raise error

        class BrokenDensity(FourthPower):
            def slopes(self, strains, material):
                raise error

        for functional in (Broken(), BrokenDensity()):
            with self.assertRaises(ZeroDivisionError) as caught:
                self.evaluate(functional)
            self.assertIs(caught.exception, error)
        self.assertGreater(self.evaluate(PressureSquared()).objective, 0)

    def test_names_must_be_free(self):
        class Travel(PressureSquared):
            name = "travel"

        with self.assertRaisesRegex(ValueError, "travel"):
            small([Travel()])


class Lifetimes(unittest.TestCase):
    def test_a_state_can_be_kept_beyond_the_evaluation(self):
        kept = []

        class Keeping(PressureSquared):
            def evaluate(self, state):
                kept.append((state, state.strain_energy, state.contacts[0].traction))
                return super().evaluate(state)

        ww.Study(small([Keeping()]).bound("pressure_squared", at_most=1e15)).evaluate()
        gc.collect()
        state, energy, traction = kept[0]
        np.testing.assert_array_equal(energy, state.strain_energy)
        self.assertGreater(-traction[:, 0].min(), 0)

    def test_a_functional_lives_as_long_as_its_case(self):
        class Own(PressureSquared):
            pass

        functional = Own()
        gone = weakref.ref(functional)
        study = ww.Study(small([functional]).bound("pressure_squared", at_most=1e15))
        del functional
        gc.collect()
        self.assertIsNotNone(gone())
        study.evaluate()
        del study
        gc.collect()
        self.assertIsNone(gone())


class Runs(unittest.TestCase):
    def test_record_and_resume_own_quantities(self):
        """A run that is stopped and resumed writes the same as one that is not."""
        functionals = [PressureSquared(), FourthPower()]
        case = small(functionals).replace({"optimizer.iterations": 4})
        case = case.minimize({"pressure_squared": 1e-9}).bound("fourth_power", at_most=1e14)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            ww.Run(case, folder / "straight").execute()
            run = ww.Run(case, folder / "stopped")
            run.execute(on_shape=lambda p: run.send("stop") if p.iteration == 2 else None)
            resumed = ww.Run.resume(folder / "stopped", functionals)
            self.assertEqual(resumed.resumed_after, 2)
            result = resumed.execute()
            self.assertEqual(result.reason, "iterations")
            for file in ("shape.levelset", "summary.json"):
                self.assertEqual(
                    (folder / "stopped" / file).read_bytes(), (folder / "straight" / file).read_bytes()
                )
            header = (folder / "straight" / "history.csv").read_text().splitlines()[0]
            self.assertIn("pressure_squared [Pa^2 m]", header)
            self.assertIn("bounded fourth_power [MPa^4 m^2]", header)
            self.assertIn("fourth_power", result.summary["bounds"][0]["name"])
            with self.assertRaises(ww.CaseError):
                ww.Run.resume(folder / "stopped")

    def test_are_killed_and_resumed(self):
        code = (
            "import os, signal, sys\n"
            "import wheelwright as ww\n"
            "from test_own import killed_case\n"
            "def kill(p):\n"
            "    if p.iteration == 3: os.kill(os.getpid(), signal.SIGKILL)\n"
            "ww.Run(killed_case(), sys.argv[1]).execute(on_shape=kill)\n"
        )
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            ww.Run(killed_case(), folder / "straight").execute()
            killed = subprocess.run(
                [sys.executable, "-c", code, str(folder / "killed")], cwd=Path(__file__).parent, timeout=60
            )
            self.assertEqual(killed.returncode, -signal.SIGKILL)
            run = ww.Run.resume(folder / "killed", [EnergyVariance()])
            self.assertIn(run.resumed_after, (2, 3))
            run.execute()
            for file in ("shape.levelset", "summary.json"):
                self.assertEqual(
                    (folder / "killed" / file).read_bytes(), (folder / "straight" / file).read_bytes()
                )


def killed_case():
    """Of five shapes, with an own criterion."""
    return small([EnergyVariance()]).replace({"optimizer.iterations": 5}).minimize({"energy_variance": 1e-2})


if __name__ == "__main__":
    unittest.main()
