"""The scripts of python/examples at small size."""

import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

NEEDED = {"scipy": "python3-scipy", "matplotlib": "python3-matplotlib", "distributed": "python3-distributed"}
if missing := [package for module, package in NEEDED.items() if not importlib.util.find_spec(module)]:
    print("not installed:", *missing)
    sys.exit(77)

FOLDER = Path(__file__).parents[1] / "examples"


class Examples(unittest.TestCase):
    def run_script(self, name, *arguments):
        done = subprocess.run(
            [sys.executable, str(FOLDER / f"{name}.py"), *map(str, arguments)],
            capture_output=True,
            text=True,
            env=os.environ | {"MPLBACKEND": "agg", "MPLCONFIGDIR": self.folder},
            timeout=300,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_paper(self):
        self.assertIn("from 44.03", self.run_script("paper", 3, self.folder))
        self.assertTrue((Path(self.folder) / "paper.svg").exists())

    def test_own_criteria(self):
        text = self.run_script("own_criteria", 3, Path(self.folder) / "run")
        self.assertEqual(text.count("passed"), 4)

    def test_scipy_holes(self):
        text = self.run_script("scipy_holes", 2)
        gradient, quotients = ([float(x) for x in part.split("]")[0].split()] for part in text.split("[")[1:3])
        for a, b in zip(gradient, quotients):
            self.assertAlmostEqual(a / b, 1, delta=0.02)

    def test_data_set(self):
        self.run_script("data_set", 4, Path(self.folder) / "wheels.csv")
        self.assertEqual(len((Path(self.folder) / "wheels.csv").read_text().splitlines()), 5)

    def test_pareto(self):
        self.assertEqual(self.run_script("pareto", 1, self.folder).count("weight"), 4)

    def test_contact_laws(self):
        self.assertEqual(self.run_script("contact_laws").count("J_e"), 5)

    def test_solid(self):
        self.assertIn("3 coordinates", self.run_script("solid", 2, 1))

    def test_pictures(self):
        self.run_script("pictures", self.folder)
        self.assertGreater((Path(self.folder) / "pictures.png").stat().st_size, 10000)

    def test_tutorial(self):
        """All code of docs/python.md in its order, with two shapes."""
        page = (FOLDER.parents[1] / "docs" / "python.md").read_text(encoding="utf-8")
        code = "".join(re.findall(r"```python\n(.*?)```", page, re.DOTALL))
        for before, after in (
            ('"optimizer.tread_band": "2 cm"', '"optimizer.tread_band": "2 cm", "optimizer.iterations": 2'),
            ('"optimizer.iterations": 100', '"optimizer.iterations": 2'),
            (".bound(", '.replace({"optimizer.iterations": 2}).bound('),
        ):
            self.assertEqual(code.count(before), 1, before)
            code = code.replace(before, after)
        check = "print(study.taylor_test('pressure_squared').order > 1.9)\n"
        script = Path(self.folder) / "tutorial.py"
        script.write_text(code + check)
        done = subprocess.run(
            [sys.executable, "tutorial.py"],
            capture_output=True,
            text=True,
            cwd=self.folder,
            env=os.environ | {"MPLBACKEND": "agg", "MPLCONFIGDIR": self.folder},
            timeout=300,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(done.stdout.rstrip().endswith("True"), done.stdout)
        self.assertTrue((Path(self.folder) / "runs" / "own" / "report.html").exists())
        self.assertTrue((Path(self.folder) / "paper.png").exists())


if __name__ == "__main__":
    unittest.main()
