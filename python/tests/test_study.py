import copy
import gc
import os
import pickle
import signal
import subprocess
import sys
import threading
import unittest
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import wheelwright as ww
from wheels import small, uneven


class Evaluations(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.study = ww.Study(uneven())
        cls.evaluation = cls.study.evaluate()

    def test_have_functions_by_name(self):
        self.assertEqual(list(self.evaluation), self.study.functions)
        objective = self.evaluation["objective"]
        self.assertEqual(objective.unit, "J/m")
        self.assertAlmostEqual(objective.by_position.sum(), objective.value)
        self.assertAlmostEqual(self.evaluation.state.strain_energy.sum(), objective.value)
        with self.assertRaisesRegex(KeyError, "objective"):
            self.evaluation["objectif"]

    def test_gradient_is_that_of_the_level_set(self):
        """The derivative along a direction is the sum of the products with the nodal gradient."""
        shape = self.study.shape
        step = shape.test_step
        direction = shape.test_direction(1, 3 * step)
        derivative = (self.evaluation["objective"].nodal_gradient * direction).sum()
        there, back = (self.study.evaluate(shape.moved(direction, by)).objective for by in (step, -step))
        self.assertAlmostEqual((there - back) / (2 * step) / derivative, 1, places=3)

    def test_gradient_of_the_volume_is_the_length_of_the_boundary(self):
        gradient = self.evaluation["volume"].gradient
        np.testing.assert_allclose(gradient.density, 1, rtol=1e-12)
        self.assertAlmostEqual(gradient.derivative(gradient.normals), gradient.weights.sum())

    def test_pickle_without_their_states(self):
        there = pickle.loads(pickle.dumps(self.evaluation))
        self.assertEqual(there.objective, self.evaluation.objective)
        self.assertEqual(there.states, [])
        self.assertEqual(there.shape, self.study.shape)
        for a, b in zip(there["objective"].gradient, self.evaluation["objective"].gradient):
            np.testing.assert_array_equal(a, b)

    def test_taylor_test_has_order_two(self):
        self.assertGreater(self.study.taylor_test().order, 1.9)
        self.assertTrue(all(check.passed for check in self.study.check_gradients()))


class Shapes(unittest.TestCase):
    def test_are_arrays(self):
        shape = ww.Shape(small())
        self.assertEqual(shape.values.shape, shape.nodes.shape[:-1])
        self.assertFalse(shape.values.flags.writeable)
        self.assertEqual(shape.with_values(shape.values), shape)
        with self.assertRaisesRegex(ValueError, r"\(24, 17\)"):
            shape.with_values(np.zeros(3))
        self.assertEqual(pickle.loads(pickle.dumps(shape)), shape)
        radius = 0.03
        hole = -ww.Shape(small()).values.max()
        self.assertAlmostEqual(hole, -radius, delta=2e-3)

    def test_contours_enclose_the_material(self):
        shape = ww.Shape(small())
        area = 0.0
        for x, y in (c.T for c in shape.contours()):
            area += (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
        self.assertAlmostEqual(area, 8 * shape.measure, delta=1e-3 * area)

    def test_evolve(self):
        study = ww.Study(small())
        evolver = ww.Evolver(study)
        velocity = evolver.velocity(study.evaluate())
        moved = evolver.move(study.shape, velocity, 1e-3)
        self.assertLess(study.evaluate(moved).objective, study.evaluate().objective)
        self.assertAlmostEqual(moved.measure, study.shape.measure, delta=1e-3 * moved.measure)
        exact = evolver.with_measure(evolver.redistance(moved), study.shape.measure)
        self.assertAlmostEqual(exact.measure / study.shape.measure, 1, places=6)


class States(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.study = ww.Study(uneven())
        cls.state = cls.study.solve()

    def test_forces_balance_the_load(self):
        for contact in self.state.contacts:
            force = contact.weight @ contact.pressure
            self.assertAlmostEqual(force / contact.rim_force.towards_ground, 1, places=8)

    def test_pressure_curves_are_of_all_positions(self):
        symmetric = ww.Study(small().replace({"load.positions": 4})).evaluate().state
        self.assertEqual((symmetric.n_positions, len(symmetric.pressure_curves())), (3, 4))
        for (place, pressure), contact in zip(self.state.pressure_curves(), self.state.contacts):
            centre = contact.weight @ (contact.pressure * contact.place[:, 1]) / (contact.weight @ contact.pressure)
            self.assertAlmostEqual(place @ pressure / pressure.sum(), centre, delta=1e-3)

    def test_arrays_have_their_shapes(self):
        n = self.state.n_positions
        self.assertEqual((n, self.state.n_sectors), (3, 8))
        u = self.state.displacement(0)
        self.assertEqual(u.shape[0], 8)
        self.assertEqual(u.shape[-1], 2)
        self.assertEqual(self.state.stress(1).shape[-1], 4)
        self.assertEqual(self.state.observations.shape[:2], (n, 96))
        rows = self.state.observation_rows
        self.assertEqual(rows.traction(self.state.observations).shape, (n, 96, rows.n_points, 2))
        with self.assertRaises(IndexError):
            self.state.displacement(7)

    def test_cells_hold_the_strain_energy(self):
        """The integral of the energy density, up to the ghost penalty and the contact's own terms."""
        energy = np.zeros(3)
        for cell in self.state.cells():
            density = cell.material.energy_density(cell.strains)
            energy += (density * cell.weights).sum(axis=(1, 2))
        np.testing.assert_allclose(energy, self.state.strain_energy, rtol=0.02)

    def test_material_is_linear_and_consistent(self):
        cell = next(self.state.cells())
        eps, law = cell.strains, cell.material
        np.testing.assert_allclose(law.energy_density(eps), (eps * law.stress(eps)).sum(axis=-1) / 2)
        lam, mu = law.lame
        np.testing.assert_allclose(law.stress(eps)[..., 2], mu * eps[..., 2])
        small_step = 1e-6 * eps
        change = law.squared_von_mises(eps + small_step) - law.squared_von_mises(eps - small_step)
        slope = 2 * (law.squared_von_mises_slope(eps) * small_step).sum(axis=-1)
        np.testing.assert_allclose(change, slope, rtol=1e-6)

    def test_views_keep_their_state_alive(self):
        place = ww.Study(small()).solve().contacts[0].place
        energy = ww.Study(small()).evaluate().state.strain_energy
        values = ww.Study(small()).shape.values
        expected = copy.deepcopy(place), copy.deepcopy(energy), copy.deepcopy(values)
        gc.collect()
        for _ in range(3):
            ww.Study(small()).solve()
        for view, copied in zip((place, energy, values), expected):
            np.testing.assert_array_equal(view, copied)

    def test_analysis_is_that_of_all_positions(self):
        analysis = ww.analyze(self.state)
        np.testing.assert_allclose(analysis.radial_force, analysis.radial_force[0], rtol=1e-8)
        np.testing.assert_array_equal(analysis.azimuths, self.state.azimuths)
        self.assertGreater(analysis.run_out, 0)


class AccurateNumbers(unittest.TestCase):
    def test_are_those_of_finer_grids_within_their_errors(self):
        study = ww.Study(small())
        rough, fine = study.accurate_numbers(0.5), study.accurate_numbers(0.01)
        self.assertEqual(rough.keys(), fine.keys())
        for key, number in fine.items():
            if number.error is not None and not number.reason:
                self.assertLessEqual(number.error, 0.01 * abs(number.value), number)
                if rough[key].error:
                    self.assertLess(abs(rough[key].value - number.value), 5 * rough[key].error, number)
        self.assertTrue(any(not number.reason for number in fine.values()))
        with self.assertRaisesRegex(ValueError, "accuracy"):
            study.accurate_numbers(0)


class Failures(unittest.TestCase):
    def test_have_reason_and_detail(self):
        study = ww.Study(small())
        with self.assertRaises(ww.ComputationError) as caught:
            study.evaluate(study.shape.moved(np.ones_like(study.shape.values)))
        self.assertEqual(caught.exception.reason, "protected_band")
        self.assertIn(caught.exception.detail, str(caught.exception))

    def test_of_arguments_say_what_was_expected(self):
        with self.assertRaisesRegex(TypeError, "expected a Shape"):
            ww.Study(small()).evaluate(3)


class Processes(unittest.TestCase):
    def test_studies_go_to_other_processes(self):
        study = ww.Study(small())
        with ProcessPoolExecutor(1) as pool:
            there = pool.submit(ww.Study.evaluate, study, study.shape).result()
        self.assertEqual(there.objective, study.evaluate().objective)

    def test_other_threads_of_python_run(self):
        """The GIL is released: two evaluations at a time, and a thread that counts meanwhile."""
        study = ww.Study(small())
        values = []
        threads = [threading.Thread(target=lambda: values.append(study.evaluate().objective)) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(values, [study.evaluate().objective] * 2)

    def test_numpy_keeps_its_threads(self):
        before = ww.settings().blas_threads
        ww.Study(small()).evaluate()
        self.assertEqual(ww.settings().blas_threads, before)
        with ww.limit_threads(1):
            ww.Study(small()).evaluate()

    def test_ctrl_c_ends_an_evaluation(self):
        code = (
            "import os, signal, threading\n"
            "import wheelwright as ww\n"
            "study = ww.Study(ww.Case.preset('paper16'))\n"
            "threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
            "try:\n"
            "    while True: study.evaluate()\n"
            "except KeyboardInterrupt: print(study.evaluate().objective > 0)\n"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.stdout, "True\n", done.stderr)


if __name__ == "__main__":
    unittest.main()
