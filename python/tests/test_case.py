import pickle
import tempfile
import unittest
from pathlib import Path

import wheelwright as ww
from wheels import SMALL, PressureSquared, small


class Keys(unittest.TestCase):
    def test_are_read_in_the_unit_of_the_file(self):
        case = small()
        self.assertEqual(case["wheel.sectors"], 8)
        self.assertEqual(case["holes.ring[1].radius"], 0.03)
        self.assertEqual(case["grid.dilatation"], "pointwise")
        self.assertIsNone(case["load.travel"])

    def test_are_set_by_name(self):
        case = small()
        case["holes.ring[1].radius"] = "25 mm"
        self.assertEqual(case["holes.ring[1].radius"], 0.025)
        case["load.force"] = 600
        self.assertNotIn("mass", case.text)
        changed = case.replace({"load.mass": 25, "wheel.sectors": 16, "grid.angular_cells": 192})
        self.assertEqual((changed["load.mass"], changed["grid.angular_cells"]), (25, 192))
        self.assertEqual(case["wheel.sectors"], 8)

    def test_that_contradict_others_change_nothing(self):
        case = small()
        with self.assertRaises(ww.CaseError):
            case["wheel.sectors"] = 7
        self.assertEqual(case["wheel.sectors"], 8)

    def test_unknown_ones_name_similar_ones(self):
        with self.assertRaisesRegex(ww.UnknownKeyError, "wheel.sectors"):
            small()["wheel.sector"]
        with self.assertRaises(KeyError):
            small()["load.mess"] = 3


class Mistakes(unittest.TestCase):
    def test_are_all_reported_with_their_lines(self):
        with self.assertRaises(ww.CaseError) as caught:
            ww.Case.parse("[wheel]\nsectors = -1\nouter = 3\n[load]\nmass = 0\n")
        self.assertEqual([p.line for p in caught.exception.problems], [2, 3, 5])
        self.assertEqual(len(str(caught.exception).splitlines()), 3)
        self.assertEqual(caught.exception.problems[0].key, "wheel.sectors")

    def test_of_a_missing_file_is_that_of_python(self):
        with self.assertRaises(FileNotFoundError):
            ww.Case("nowhere.toml")


class Cases(unittest.TestCase):
    def test_come_from_files_and_presets(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "case.toml"
            file.write_text(SMALL)
            self.assertEqual(ww.Case(file), small())
            self.assertEqual(ww.Case(folder), small())
        for name in ww.presets():
            self.assertIn(ww.Case.preset(name).dimension, (2, 3))
        with self.assertRaises(KeyError):
            ww.Case.preset("no such wheel")

    def test_pickle_with_their_functionals(self):
        case = small([PressureSquared()]).bound("pressure_squared", at_most=1e9)
        copy = pickle.loads(pickle.dumps(case))
        self.assertEqual(copy, case)
        self.assertEqual(copy.functionals[0].name, "pressure_squared")

    def test_resolved_text_is_the_same_case(self):
        self.assertEqual(ww.Case.parse(small().resolved), small())

    def test_objective_and_bounds_have_methods(self):
        case = small().minimize({"strain_energy": 0.5, "travel": 200}).bound("peak_pressure", at_most="20 MPa")
        self.assertEqual(case["objective.strain_energy"], 0.5)
        self.assertEqual(case["objective.term[1].quantity"], "travel")
        case = case.bound("travel", at_most="2 mm", over="worst")
        self.assertEqual(case["constraint[2].over"], "worst")
        self.assertEqual(small().minimize("peak_pressure")["objective.minimize"], "peak_pressure")


if __name__ == "__main__":
    unittest.main()
