"""Tests of scripts/reproduction. usage: reproduction_test.py PROGRAM, from the repository's top folder."""

import io
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, "scripts")

from reproduction.__main__ import chosen, summary  # noqa: E402
from reproduction.figures import figures  # noqa: E402
from reproduction.progress import CaseProgress, bar_text  # noqa: E402
from reproduction.runs import _von_mises, shear_modulus  # noqa: E402
from reproduction.section import both_ways, claims, verdict  # noqa: E402

program = sys.argv.pop(1)


class Progress(unittest.TestCase):
    def test_bar_fits_any_width_and_fills(self):
        for width in range(1, 120):
            self.assertLessEqual(len(bar_text(0.5, 3, 21, ["uniform_je", "rules_je"], 130.0, width)), width)
        filled = [bar_text(k / 24, 0, 1, [], None, 80).count("#") for k in range(25)]
        self.assertEqual(filled, list(range(25)))
        self.assertIn("2:10", bar_text(0.5, 3, 21, [], 130.0, 80))

    def test_a_log_gets_one_plain_line_a_case(self):
        log = io.StringIO()
        with CaseProgress(["a", "b"], {"a": 1.0}, log) as progress:
            for name in ("a", "b"):
                progress.started(name)
                progress.finished(name, "remark" if name == "b" else "")
        lines = log.getvalue().splitlines()
        self.assertEqual(len(lines), 2)
        self.assertNotIn("\x1b", log.getvalue())
        self.assertTrue(lines[0].startswith("[1/2] a") and lines[1].endswith("remark"))

    def test_work_done_counts_by_the_time_that_cases_took_before(self):
        progress = CaseProgress(["long", "short"], {"long": 30.0, "short": 10.0}, io.StringIO())
        progress.started("short")
        progress.finished("short", "")
        self.assertAlmostEqual(progress.fraction(0.0), 0.25)
        progress.started("long")
        begin = progress._started["long"]
        self.assertAlmostEqual(progress.fraction(begin + 15), 0.25 + 15 / 40)
        self.assertLess(progress.fraction(begin + 1000), 1)


class Page(unittest.TestCase):
    def test_figures_are_chosen_by_numbers_and_ranges(self):
        self.assertEqual([f.label for f in chosen(["11", "17-22"])], ["10-11", "16-21", "22"])
        self.assertEqual(chosen([]), figures)
        for wrong in ("8", "x", "24-30"):
            with self.assertRaises(SystemExit):
                chosen([wrong])

    def test_every_case_exists(self):
        for figure in figures:
            for name in figure.cases:
                self.assertTrue(Path(f"cases/paper/{name}.toml").exists(), name)

    def test_verdicts_are_counted_by_claims(self):
        rows = claims(("a", "1", verdict(True)), ("b", "2", both_ways(True, False)), ("c", "3", verdict(False)))
        text = summary({"1": rows})
        self.assertTrue(text.startswith("1 claims are confirmed, 1 in part, 1 contradicted"), text)
        self.assertEqual(text.count("\n- "), 2)
        self.assertEqual(both_ways(False, False), verdict(False))


class Stress(unittest.TestCase):
    def test_von_mises_of_a_linear_displacement(self):
        points = [0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0]
        shear = [x for k in range(4) for x in (1e-3 * points[3 * k + 1], 0, 0)]
        self.assertAlmostEqual(_von_mises([0, 1, 2, 3], points, shear), shear_modulus * 1e-3 * 3**0.5, places=3)
        turn = [x for k in range(4) for x in (-points[3 * k + 1], points[3 * k], 0)]
        self.assertAlmostEqual(_von_mises([0, 1, 2, 3], points, turn), 0, places=3)


class Command(unittest.TestCase):
    def written(self, folder: Path, jobs: int) -> dict[str, bytes]:
        """The page, without the times in it, and its pictures."""
        folder.mkdir()
        command = [sys.executable, "-m", "reproduction", program, "23", "--iterations", "1", "--jobs", str(jobs)]
        subprocess.run(
            [*command, "--page", str(folder / "page.md"), "--runs", str(folder / "runs")],
            check=True,
            capture_output=True,
            env={**os.environ, "PYTHONPATH": "scripts", "PYTHONDONTWRITEBYTECODE": "1"},
        )
        files = {file.name: file.read_bytes() for file in (folder / "page").iterdir()}
        text = (folder / "page.md").read_text()
        files["page.md"] = re.sub(r"Last written by .*?that run\.|# \d+ s", "", text, flags=re.DOTALL).encode()
        return files

    def test_two_cases_at_a_time_give_what_one_gives(self):
        with tempfile.TemporaryDirectory() as folder:
            one, two = self.written(Path(folder) / "one", 1), self.written(Path(folder) / "two", 2)
        self.assertIn("holes108_je_comparison.svg", one)
        self.assertEqual(one, two)


if __name__ == "__main__":
    unittest.main()
