"""Tests of report.html in a browser. usage: report_test.py PROGRAM, from the repository's top folder."""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    print("The tests of report.html were skipped: they need chromium, chromium-driver and python3-selenium.")
    sys.exit(77)

program = sys.argv.pop(1)

# A wheel without any symmetry, with friction and a torque, and a title that tries to leave its place.
CASE = """
title = '''</script><script>document.title = "broken out"</script> @DATA@ & "quoted" '''
[wheel]
sectors = 7
[load]
positions = 3
torque = 40
[contact]
friction = 0.4
[[holes.ring]]
count = 7
center_radius = 0.266
radius = 0.03
phase = 0.2
[[holes.ring]]
count = 7
center_radius = 0.25
radius = 0.02
phase = 0.6
[grid]
radial_cells = 14
angular_cells = 189
tread_levels = 1
[optimizer]
iterations = 4
rim_band = 0.01
tread_band = 0.02
"""


def run_program(*arguments):
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    result = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, env=environment,
                            check=False, timeout=300)
    assert result.returncode == 0, result.stderr
    return result.stdout


def shown(value):
    """As the page shows a number: five digits."""
    return f"{float(f'{value:.5g}'):.10g}"


def luminance(colour):
    channels = [int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    low, high = sorted((luminance(a), luminance(b)))
    return (high + 0.05) / (low + 0.05)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = Path(cls.temporary.name)
        (cls.folder / "case.toml").write_text(CASE)
        run_program("run", cls.folder / "case.toml", "--output", cls.folder / "run")
        cls.summary = json.loads((cls.folder / "run/summary.json").read_text())
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader", "--window-size=1200,2400"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.browser = webdriver.Chrome(options=options)
        cls.addClassCleanup(cls.browser.quit)

    def open(self, file):
        self.browser.get_log("browser")
        self.browser.get_log("performance")
        self.browser.get(f"file://{file}")

    def text(self, name):
        return self.browser.find_element(By.ID, name).text

    def pixels(self, name):
        """A checksum of what the canvas before an element's controls shows."""
        return self.browser.execute_script(
            "return document.getElementById(arguments[0]).closest('figure').querySelector('canvas').toDataURL()", name)

    def test_nothing_fails_and_nothing_is_fetched(self):
        page = self.folder / "run/report.html"
        self.open(page)
        errors = [entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [])
        messages = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        urls = {m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"}
        self.assertEqual({u for u in urls if not u.startswith("data:")}, {f"file://{page}"})
        self.assertLess(page.stat().st_size, 5e6)

    def test_a_title_stays_a_title(self):
        self.open(self.folder / "run/report.html")
        self.assertNotEqual(self.browser.title, "broken out")
        self.assertIn("</script><script>", self.browser.find_element(By.TAG_NAME, "h1").text)

    def test_the_table_has_the_numbers_of_the_summary(self):
        self.open(self.folder / "run/report.html")
        data = json.loads(self.browser.execute_script("return document.getElementById('data').textContent"))
        for number in data["numbers"]:
            before, after = self.browser.find_elements(By.CSS_SELECTOR, f"td[data-key={number['key']}]")
            for cell, wheel in ((before, "before"), (after, "after")):
                value = self.summary[wheel][number["key"]] * number["factor"]
                self.assertAlmostEqual(float(cell.text), value, delta=1e-4 * abs(value), msg=number["key"])

    def test_questions_have_their_answers(self):
        self.open(self.folder / "run/report.html")
        after = self.summary["after"]
        for question, numbers in {
            "stiffness": [after["stiffness_N_per_m"] * 1e-3],
            "evenness": [after["run_out_m"] * 1e3, after["force_variation_N"]],
            "volume": [100 * after["volume_fraction"]],
            "stress": [after["peak_von_mises_Pa"] * 1e-6],
            "pressure": [after["peak_pressure_Pa"] * 1e-6],
            "travel": [after["mean_travel_m"] * 1e3],
            "load": [after["load_N"]],
            "strain": [100 * after["largest_strain"], 100 * after["travel_by_ring_thickness"]],
            "change": [],
            "trust": [],
            "making": [],
        }.items():
            text = self.text(f"run0-{question}")
            self.assertTrue(text)
            found = [float(n) for n in re.findall(r"\d+(?:\.\d+)?(?:e-?\d+)?", text)]
            for number in numbers:
                self.assertTrue(any(abs(f - number) <= 1e-4 * abs(number) for f in found), (question, text, number))
        self.assertIn("remark", self.text("run0-trust"))  # four shapes do not converge

    def test_the_wheel_rolls_by_mouse_and_by_keyboard(self):
        self.open(self.folder / "run/report.html")
        slider = self.browser.find_element(By.ID, "run0-position")
        seen = [(self.pixels("run0-position"), self.text("run0-position-text"))]
        for position in (1, 2):
            slider.send_keys(Keys.ARROW_RIGHT)
            self.assertEqual(slider.get_attribute("value"), str(position))
            seen.append((self.pixels("run0-position"), self.text("run0-position-text")))
        self.assertEqual(len({picture for picture, _ in seen}), 3)
        self.assertEqual(len({text for _, text in seen}), 3)
        button = self.browser.find_element(By.ID, "run0-roll")
        button.click()
        self.assertEqual(button.get_attribute("aria-pressed"), "true")
        moved = "const s = document.getElementById('run0-position'), old = s.value, done = arguments[0];" \
                "const wait = () => s.value !== old ? done(true) : setTimeout(wait, 20); wait();"
        self.assertTrue(self.browser.execute_async_script(moved))
        button.send_keys(Keys.ENTER)
        self.assertEqual(button.get_attribute("aria-pressed"), "false")

    def test_shapes_go_from_the_first_to_the_last(self):
        self.open(self.folder / "run/report.html")
        slider = self.browser.find_element(By.ID, "run0-shape")
        self.assertEqual(slider.get_attribute("value"), "4")
        last = self.pixels("run0-shape")
        slider.send_keys(Keys.HOME)
        self.assertEqual(slider.get_attribute("value"), "0")
        self.assertNotEqual(self.pixels("run0-shape"), last)
        self.assertIn(shown(self.summary["before"]["objective_J_per_m"]), self.text("run0-shape-text"))

    def test_controls_have_names(self):
        self.open(self.folder / "run/report.html")
        for control in self.browser.find_elements(By.CSS_SELECTOR, "input, select, button, canvas:not([aria-hidden])"):
            self.assertTrue(control.accessible_name, control.get_attribute("outerHTML"))

    def test_texts_stand_out_in_light_and_dark(self):
        style = Path("src/wheelwright/page/assets/report.css").read_text()
        light, dark = (dict(re.findall(r"--(\w+): (#[0-9a-f]{6})", block)) for block in
                       re.findall(r":root \{(.*?)\}", style, re.DOTALL))
        for theme in (light, dark):
            for ink in ("ink", "quiet", "accent", "good", "bad"):
                for ground in ("paper", "panel"):
                    self.assertGreaterEqual(contrast(theme[ink], theme[ground]), 4.5, (ink, ground))

    def test_a_stopped_and_resumed_run_shows_all_its_shapes(self):
        straight, stopped = self.folder / "run", self.folder / "stopped"
        run_program("run", self.folder / "case.toml", "--output", stopped, "--iterations", 2)
        run_program("resume", stopped, "--iterations", 4)
        self.assertEqual((stopped / "outlines.jsonl").read_bytes(), (straight / "outlines.jsonl").read_bytes())

    def test_runs_stand_side_by_side(self):
        page = self.folder / "both.html"
        other = self.folder / "other"
        run_program("run", self.folder / "case.toml", "--output", other, "--iterations", 1)
        run_program("report", self.folder / "run", other, "--output", page)
        self.open(page)
        errors = [entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [])
        self.assertEqual(len(self.browser.find_elements(By.TAG_NAME, "article")), 2)
        told = json.loads((other / "summary.json").read_text())["after"]["stiffness_N_per_m"] * 1e-3
        self.assertIn(shown(told), self.text("run1-stiffness"))
        again = subprocess.run([program, "report", self.folder / "run", "--output", page], check=False,
                               capture_output=True)
        self.assertEqual(again.returncode, 4)


if __name__ == "__main__":
    unittest.main()
