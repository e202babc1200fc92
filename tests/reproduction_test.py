"""Tests of scripts/reproduction. usage: reproduction_test.py PROGRAM, from the repository's top folder."""

import io
import math
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
from reproduction.execute import Records, Task, follows_rounding, of_shape, perturbations, perturbed, tasks_of  # noqa: E402
from reproduction.family import Family, Values, Verdict, both, judged, over  # noqa: E402
from reproduction.figures import figures  # noqa: E402
from reproduction.hole import measured  # noqa: E402
from reproduction.progress import CaseProgress, bar_text  # noqa: E402
from reproduction.runs import Run, _von_mises, shear_modulus  # noqa: E402
from reproduction.section import both_ways, claims, told  # noqa: E402

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
        yes, no, open_ = Verdict.confirmed, Verdict.contradicted, Verdict.undecided
        rows = claims(
            ("a", "1", told(yes)), ("b", "2", both_ways(yes, open_)), ("c", "3", told(no)), ("d", "4", told(open_))
        )
        text = summary({"1": rows})
        self.assertTrue(
            text.startswith(
                "1 claims are confirmed, 1 contradicted, 1 undecided; 1 have several verdicts, of which 1 are undecided "
            ),
            text,
        )
        self.assertEqual(text.count("\n- "), 3)
        self.assertEqual(both_ways(no, no), told(no))


class HoleSize(unittest.TestCase):
    @staticmethod
    def turned(points, angle):
        c, s = math.cos(angle), math.sin(angle)
        return [(c * x - s * y, s * x + c * y) for x, y in points]

    def test_width_of_a_tilted_ellipse_anywhere_on_the_ring(self):
        a, b, distance, n = 45.0, 25.0, 270.0, 2000
        for tilt in (0.0, 0.4, 1.2, math.pi / 2):
            ellipse = [(a * math.cos(2 * math.pi * k / n), b * math.sin(2 * math.pi * k / n)) for k in range(n)]
            placed = [(x + distance, y) for x, y in self.turned(ellipse, tilt)]
            for azimuth in (0.0, 1.0, math.pi - 0.01, 4.0):
                hole = measured(self.turned(placed, azimuth))
                exact = 2 * math.hypot(a * math.sin(tilt), b * math.cos(tilt))
                self.assertAlmostEqual(hole.width, exact, delta=1e-3)
                if tilt == 0:
                    self.assertAlmostEqual(hole.length, 2 * a, delta=1e-3)

    def test_width_of_a_piece_of_a_sector_is_the_chord_of_its_outer_arc(self):
        inner, outer, half, n = 220.0, 320.0, 0.15, 400
        angles = [half * (2 * k / n - 1) for k in range(n + 1)]
        piece = [(outer * math.cos(t), outer * math.sin(t)) for t in angles]
        piece += [(inner * math.cos(t), inner * math.sin(t)) for t in reversed(angles)]
        for azimuth in (0.3, 3.1):
            for contour in (piece, piece[::-1]):
                hole = measured(self.turned(contour, azimuth))
                self.assertAlmostEqual(hole.width, 2 * outer * math.sin(half), delta=1e-6)
                self.assertAlmostEqual(hole.length, outer - inner, delta=1e-6)
                self.assertAlmostEqual(hole.outer_radius, outer, delta=1e-6)


def family(*numbers: float) -> Family:
    """Runs that only have a time."""
    return Family("name", [Run("name", Path(), number) for number in numbers])


class Families(unittest.TestCase):
    def test_claims_are_judged_on_all_combinations(self):
        ratios = over(lambda a, b: a.seconds / b.seconds, family(1, 2), family(4, 8))
        self.assertEqual(sorted(ratios), [0.125, 0.25, 0.25, 0.5])
        self.assertIs(judged(lambda ratio: ratio < 1, ratios), Verdict.confirmed)
        self.assertIs(judged(lambda ratio: ratio > 1, ratios), Verdict.contradicted)
        self.assertIs(judged(lambda ratio: ratio < 0.3, ratios), Verdict.undecided)

    def test_all_conditions_must_hold(self):
        yes, no, open_ = Verdict.confirmed, Verdict.contradicted, Verdict.undecided
        self.assertIs(both(yes, yes), yes)
        self.assertIs(both(yes, open_), open_)
        self.assertIs(both(open_, no, yes), no)

    def test_ranges_are_rounded_outwards(self):
        self.assertEqual(Values([1.26, 1.31, 1.44]).text(1, "mm"), "1.2 to 1.5 mm")
        self.assertEqual(Values([-0.021, 0.0149]).change(), "-2.1 to +1.5 %")
        self.assertEqual(Values([-0.021, -0.0001]).change(), "-2.1 to 0.0 %")
        self.assertEqual(Values([0.1234]).percent(), "12.3 %")
        self.assertEqual(Values([2.0, 2.0]).text(0), "2")
        self.assertEqual(Values([27.995, 28.438, 28.791]).text(3, "J/m"), "27.9 to 28.8 J/m")
        self.assertEqual(Values([74.41, 75.87]).text(2, "%"), "74.4 to 75.9 %")
        for low, high in ((0.061, 0.069), (-3.149, -3.141), (5.0, 7.25)):
            first, last = map(float, Values([high, low]).text(2).split(" to "))
            self.assertTrue(first <= low and high <= last)

    def test_the_shape_of_another_run_takes_the_place_of_holes_and_descent(self):
        for figure in figures:
            for case, shape in figure.shapes:
                self.assertIn(shape, figure.cases)
                text = of_shape(Path(f"cases/paper/{case}.toml").read_text(), shape)
                self.assertNotRegex(text, r"\[\[")
                self.assertEqual(re.findall(r"^iterations = .*", text, re.MULTILINE), ["iterations = 0"])
                self.assertIn(f'from = "{shape}"', text)

    def test_perturbed_cases_differ_by_their_radii_alone(self):
        for case in sorted(Path("cases/paper").glob("rules_*.toml")):
            text = case.read_text()
            self.assertTrue(follows_rounding(text), case)
            changed = perturbed(text, 1e-5)
            self.assertNotIn("expect", changed)
            self.assertNotIn("pictures_every", changed)
            radii = [[float(r) for r in re.findall(r"^radius = (\S+)", t, re.MULTILINE)] for t in (text, changed)]
            self.assertTrue(radii[0])
            for before, after in zip(*radii):
                self.assertAlmostEqual(after / before - 1, 1e-5, places=9)
            kept = re.sub(r"^radius = .*|^\[output\]\n.*\n", "", changed, flags=re.MULTILINE).splitlines()
            self.assertLessEqual({line for line in kept if line}, set(text.splitlines()))

    def test_only_runs_that_follow_rounding_are_repeated(self):
        self.assertEqual(tasks_of("uniform_je"), [Task("uniform_je")])
        tasks = tasks_of("rules_je")
        self.assertGreaterEqual(len(tasks), 8)
        self.assertEqual(len({task.name for task in tasks}), len(tasks))
        self.assertEqual(len(set(perturbations)), len(perturbations))
        self.assertTrue(all(1e-6 <= abs(p) <= 1e-5 for p in perturbations))


class Reuse(unittest.TestCase):
    def test_a_finished_run_is_found_again_unless_program_case_or_options_differ(self):
        with tempfile.TemporaryDirectory() as name:
            folder, task = Path(name), Task("rules_je", 3)
            run = Run(task.name, folder / task.name, 1.5, failure="why", unmet=["a", "b"], expected=4)
            records = Records(program, folder, [])
            self.assertIsNone(records.find(task))
            records.keep(task, run)
            found = Records(program, folder, []).find(task)
            self.assertEqual(vars(found), vars(run))
            self.assertIsNone(Records(program, folder, ["--iterations", "1"]).find(task))
            self.assertIsNone(Records(sys.executable, folder, []).find(task))
            self.assertIsNone(records.find(Task("rules_je", 4)))


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
        command = [sys.executable, "-m", "reproduction", program, "22", "--iterations", "1", "--jobs", str(jobs)]
        subprocess.run(
            [*command, "--page", str(folder / "page.md"), "--runs", str(folder / "runs")],
            check=True,
            capture_output=True,
            env={**os.environ, "PYTHONPATH": "scripts", "PYTHONDONTWRITEBYTECODE": "1"},
        )
        files = {file.name: file.read_bytes() for file in (folder / "page").iterdir()}
        text = (folder / "page.md").read_text()
        files["page.md"] = re.sub(r"Last written by .*?of one\srun\.|# \d+ s", "", text, flags=re.DOTALL).encode()
        return files

    def test_two_cases_at_a_time_give_what_one_gives(self):
        with tempfile.TemporaryDirectory() as folder:
            one, two = self.written(Path(folder) / "one", 1), self.written(Path(folder) / "two", 2)
        self.assertIn("holes48_je_comparison.svg", one)
        self.assertEqual(one, two)


if __name__ == "__main__":
    unittest.main()
