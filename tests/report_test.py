"""Tests of report.html in a browser. usage: report_test.py PROGRAM, from the repository's top folder."""

import base64
import csv
import functools
import json
import math
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import support

support.skip_without_browser()

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select


program = sys.argv.pop(1)
run_program = functools.partial(support.run_program, program)

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
step = 10  # so long that a trial is rejected
rim_band = 0.01
tread_band = 0.02
"""


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


# Texts that contrast less with what is behind them than WCAG AA asks (4.5), in the page as it is shown.
LOW_CONTRAST = """
    const numbers = (text) => text.match(/[\\d.]+/g).map(Number);
    const luminance = (rgb) => rgb.slice(0, 3).map((c) => c / 255)
      .map((c) => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
      .reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
    const behind = (element) => {
      for (let e = element; e; e = e.parentElement) {
        const rgb = numbers(getComputedStyle(e).backgroundColor);
        if (rgb.length === 3 || rgb[3] === 1) return rgb;
      }
      return [255, 255, 255];
    };
    const faint = [], walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    let texts = 0;
    for (let node; (node = walker.nextNode());) {
      const element = node.parentElement;
      if (!node.data.trim() || !element.offsetParent || element.closest("script, style, noscript")) continue;
      ++texts;
      const [low, high] = [luminance(numbers(getComputedStyle(element).color)), luminance(behind(element))].sort((a, b) => a - b);
      if ((high + 0.05) / (low + 0.05) < 4.5) faint.push(node.data.slice(0, 60));
    }
    return texts > 50 ? faint : ["too few texts"];"""


# Its material in the middle of the holes is held by nothing.
FAILING_CASE = """
[wheel]
sectors = 7
[load]
positions = 2
[[shape.circle]]
count = 7
center_radius = 0.27
radius = 0.035
[[shape.circle]]
as = "material"
count = 7
center_radius = 0.27
radius = 0.012
[grid]
radial_cells = 14
angular_cells = 189
tread_levels = 0
[optimizer]
iterations = 2
rim_band = 0.01
tread_band = 0.02
"""


# In 3D, small, without symmetry.
SOLID_CASE = """
[wheel]
dimension = 3
sectors = 7
[material]
poissons_ratio = 0.3
[load]
positions = 2
[[holes.ring]]
count = 7
center_radius = 0.255
radius = 0.025
phase = 0.2
[grid]
degree = 1
radial_cells = 10
angular_cells = 112
axial_cells = 2
[optimizer]
iterations = 1
rim_band = 0.014
tread_band = 0.028
"""


# Two loads and two bounds, of which one is active.
LOADS_CASE = """
[wheel]
sectors = 7
[material]
density = 1100
[load]
positions = 2
mass = 200
[[load.case]]
name = "straight"
[[load.case]]
name = "kerb"
mass = 400
[[holes.ring]]
count = 7
center_radius = 0.266
radius = 0.03
phase = 0.2
[objective]
minimize = "mass"
[[constraint]]
quantity = "stiffness"
at_least = 85e6
[[constraint]]
quantity = "run_out"
at_most = 0.01
[grid]
radial_cells = 14
angular_cells = 189
tread_levels = 0
[optimizer]
iterations = 40
rim_band = 0.01
tread_band = 0.02
"""


def shown_value(text):
    """The value of a number that is shown with or without its error."""
    return float(text.split(" \u00b1 ")[0].replace("\u2212", "-"))


class Browser:
    """A page opened in a browser, for the classes below."""

    case = None

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = Path(cls.temporary.name)
        (cls.folder / "case.toml").write_text(cls.case)
        run_program("run", cls.folder / "case.toml", "--output", cls.folder / "run")
        cls.summary = json.loads((cls.folder / "run/summary.json").read_text())
        cls.browser = support.open_browser(1200, 2400)
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

    @property
    def page(self):
        return self.folder / "run/report.html"

    def test_nothing_fails_and_nothing_is_fetched(self):
        page = self.folder / "run/report.html"
        self.open(page)
        errors = [entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [])
        messages = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        urls = {m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"}
        self.assertEqual({u for u in urls if not u.startswith("data:")}, {f"file://{page}"})
        self.assertLess(page.stat().st_size, 5e6)


class Page(Browser, unittest.TestCase):
    case = CASE

    def test_a_title_stays_a_title(self):
        self.open(self.folder / "run/report.html")
        self.assertNotEqual(self.browser.title, "broken out")
        self.assertIn("</script><script>", self.browser.find_element(By.TAG_NAME, "h1").text)

    def test_the_table_has_the_numbers_of_the_summary(self):
        self.open(self.folder / "run/report.html")
        data = json.loads(self.browser.execute_script("return document.getElementById('data').textContent"))
        for number in data["runs"][0]["numbers"]:
            if number["key"] not in self.summary["after"]:
                continue
            before, after = self.browser.find_elements(By.CSS_SELECTOR, f"td[data-key={number['key']}]")
            for cell, wheel in ((before, "before"), (after, "after")):
                value = self.summary[wheel][number["key"]] * number["factor"]
                error = self.summary[wheel].get("errors", {}).get(number["key"]) or 0
                self.assertAlmostEqual(shown_value(cell.text), value, msg=number["key"],
                                       delta=1e-4 * abs(value) + error * number["factor"])

    def test_questions_have_their_answers(self):
        self.open(self.folder / "run/report.html")
        after = self.summary["after"]
        for question, numbers in {
            "stiffness": [after["stiffness_N_per_m"] * 1e-3],
            "evenness": [after["run_out_m"] * 1e3, after["force_variation_N"]],
            "volume": [100 * after["volume_fraction"]],
            "wall": [after["minimum_wall_m"] * 1e3],
            "edges": [after["internal_corner_radius_m"] * 1e3, after["roughness_turns"]],
            "stress": [after["peak_von_mises_Pa"] * 1e-6, after["peak_von_mises_place"]["radius_m"] * 1e3],
            "pressure": [after["peak_pressure_Pa"] * 1e-6],
            "travel": [after["mean_travel_m"] * 1e3],
            "load": [after["load_N"]],
            "strain": [100 * after[key] for key in ("largest_strain", "travel_by_ring_thickness", "linear_theory_error")],
            "change": [abs(100 * (after[key] / self.summary["before"][key] - 1))
                       for key in ("mean_travel_m", "run_out_m", "peak_von_mises_Pa")],
            "trust": [],
            "making": [len(self.trials())],
        }.items():
            text = self.text(f"run0-{question}")
            self.assertTrue(text)
            found = [float(n) for n in re.findall(r"\d+(?:\.\d+)?(?:e-?\d+)?", text)]
            for number in numbers:
                self.assertTrue(any(abs(f - number) <= 1e-4 * abs(number) + 0.005 * (question == "change")
                                    for f in found), (question, text, number))
        is_rough = after["roughness_turns"] > 0.9
        self.assertTrue(self.text("run0-edges").startswith("No" if is_rough else "Yes"))
        self.assertIn("remark", self.text("run0-trust"))  # four shapes do not converge

    def trials(self):
        with open(self.folder / "run/history.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_remarks_limits_and_rejected_trials_are_told(self):
        self.open(self.page)
        flags = [item.text for item in self.browser.find_elements(By.CSS_SELECTOR, "#run0-flags li")]
        for part in ("contact patch is only", "hole is 6.0 cells wide", "before it converged"):
            self.assertEqual(len([text for text in flags if part in text]), 1, part)
        limits = [item.text for item in self.browser.find_elements(By.CSS_SELECTOR, "#run0-limits li")]
        for part in ("linear elastic", "3 load positions", "plane strain", "14 x 189 cells"):
            self.assertEqual(len([text for text in limits if part in text]), 1, part)
        walls = float(re.search(r"thinnest wall is ([\d.]+) cells", " ".join(limits))[1])
        self.assertAlmostEqual(walls, self.summary["after"]["minimum_wall_m"] / self.shortest_cell(), delta=0.05)
        rejected = [row["reason"] for row in self.trials() if row["accepted"] == "0"]
        self.assertTrue(rejected)
        made = self.browser.find_element(By.XPATH, "//h2[text()='How it was made']/following-sibling::p").text
        self.assertIn(f"{len(self.trials())} trial shapes, {len(rejected)} rejected", made)
        for reason in set(rejected):
            self.assertIn(f"{reason.replace('_', ' ')}: {rejected.count(reason)}", made)
        events = [row["iteration"] for row in self.trials() if row["accepted"] == "1" and row["events"]]
        told = self.browser.find_elements(By.CSS_SELECTOR, "#run0-events li")
        self.assertEqual([item.get_attribute("textContent").split(":")[0] for item in told],
                         [f"Shape {shape}" for shape in events])

    @staticmethod
    def shortest_cell():
        """The resolution of the grid of CASE, as check counts cells [m]."""
        return min((0.34 - 0.2) / 14, 2 * math.pi * 0.27 / 189)

    def test_all_texts_stand_out_and_nothing_is_wider_than_a_phone(self):
        for theme in ("light", "dark"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
                {"name": "prefers-color-scheme", "value": theme}]})
            self.open(self.page)
            faint = self.browser.execute_script(LOW_CONTRAST)
            self.assertEqual(faint, [], theme)
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": 390, "height": 800, "deviceScaleFactor": 1, "mobile": True})
        self.open(self.page)
        self.assertLessEqual(self.browser.execute_script("return document.documentElement.scrollWidth"), 390)
        table = self.browser.find_element(By.CSS_SELECTOR, ".wide")
        self.assertLessEqual(table.get_property("scrollWidth"), table.get_property("clientWidth"))
        self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def test_curves_stand_out(self):
        colours = re.search(r"curveColours = \[(.*?)\]", Path("src/wheelwright/output/page/assets/colours.js").read_text())[1]
        for colour in re.findall(r"#[0-9a-f]{6}", colours):
            for panel in ("#f6f8fa", "#161b22"):
                self.assertGreaterEqual(contrast(colour, panel), 3, colour)

    def test_paper_shows_what_the_screen_does(self):
        dark = {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", dark)
        self.open(self.page)
        dark_ink = self.browser.execute_script("return getComputedStyle(document.body).color")
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print", **dark})
        self.browser.execute_script("dispatchEvent(new Event('beforeprint'))")
        ink, background = self.browser.execute_script(
            "const style = getComputedStyle(document.body); return [style.color, style.backgroundColor]")
        self.assertNotEqual(ink, dark_ink)
        self.assertEqual(background, "rgb(255, 255, 255)")
        self.assertFalse(self.browser.find_element(By.ID, "run0-roll").is_displayed())
        # What WebGL drew stands there as what paper shows.
        covered = self.browser.execute_script("""
            const copy = document.querySelector(".print-copy");
            const data = copy.getContext("2d").getImageData(0, 0, copy.width, copy.height).data;
            let covered = 0;
            for (let k = 3; k < data.length; k += 4) covered += data[k] === 255;
            return covered / (data.length / 4);""")
        self.assertTrue(0.3 < covered < 0.7, covered)
        self.assertTrue(self.browser.execute_script(
            "return document.querySelector('.print-copy').nextElementSibling === null"))
        self.browser.execute_script("dispatchEvent(new Event('afterprint'))")
        self.assertEqual(self.browser.find_elements(By.CLASS_NAME, "print-copy"), [])
        pdf = base64.b64decode(self.browser.execute_cdp_cmd("Page.printToPDF", {})["data"])
        self.assertTrue(pdf.startswith(b"%PDF"))
        self.assertTrue(2 <= len(re.findall(rb"/Type\s*/Page\b", pdf)) <= 6)
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})

    def test_the_points_of_a_sweep_open_its_wheels(self):
        sweep = self.folder / "sweep"
        run_program("sweep", self.folder / "case.toml", "load.mass=200,300", "--output", sweep)
        told = run_program("report", sweep)
        self.assertEqual(told.strip(), str(sweep / "sweep.html"))
        self.open(sweep / "sweep.html")
        self.assertEqual([e for e in self.browser.get_log("browser") if e["level"] == "SEVERE"], [])
        links = self.browser.find_elements(By.CSS_SELECTOR, "#plot a")
        self.assertEqual(len(links), 2)
        self.assertGreaterEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#plot .error")), 2)
        self.assertIn("\u00b1", self.text("table"))
        for link in links:
            page = sweep / link.get_attribute("href")["baseVal"] if isinstance(link.get_attribute("href"), dict) else \
                sweep / self.browser.execute_script("return arguments[0].getAttribute('href')", link)
            self.assertTrue(page.is_file(), page)
        links[0].send_keys(Keys.ENTER)
        self.assertTrue(self.browser.current_url.endswith("report.html"), self.browser.current_url)

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

    def test_the_loaded_wheel_is_seen_first_and_whole(self):
        bottom = "const of = (e) => e.getBoundingClientRect().bottom + scrollY; return of(arguments[0])"
        try:
            for width, height in ((1440, 900), (1280, 720)):
                self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                             {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
                self.open(self.page)
                picture = self.browser.find_element(By.CSS_SELECTOR, "figure canvas")
                self.assertLess(self.browser.execute_script(bottom, picture), height)
                table = self.browser.find_element(By.TAG_NAME, "table")
                for before_it in self.browser.find_elements(By.CSS_SELECTOR, "figure canvas"):
                    self.assertLess(before_it.location["y"], table.location["y"])
        finally:
            self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

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
        style = Path("src/wheelwright/output/page/assets/report.css").read_text()
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

    def test_a_bound_that_is_not_kept_is_told_by_the_run_and_by_the_report_after_it(self):
        case, run, page = (self.folder / name for name in ("bound.toml", "bound", "bound.html"))
        case.write_text(CASE + "[objective]\nminimize = 'volume_fraction'\n"
                        "[[constraint]]\nquantity = 'stiffness'\nat_least = 1e9\n")
        ended = subprocess.run([program, "run", case, "--iterations", "1", "--output", run], check=False,
                               capture_output=True)
        self.assertEqual(ended.returncode, 9)
        run_program("report", run, "--output", page)
        told = json.loads((run / "summary.json").read_text())["bounds"]
        self.assertEqual([bound["is_kept"] for bound in told], [False])
        for file in (run / "report.html", page):
            self.open(file)
            data = json.loads(self.browser.execute_script("return document.getElementById('data').textContent"))
            (shown_bound,) = data["runs"][0]["summary"]["bounds"]
            self.assertEqual({key: shown_bound[key] for key in ("name", "bound", "is_kept")},
                             {key: told[0][key] for key in ("name", "bound", "is_kept")})
            self.assertAlmostEqual(shown_bound["value"] / told[0]["value"], 1, delta=1e-9)
            self.assertIn("stiffness", self.browser.find_element(By.CSS_SELECTOR, ".flags").text)

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
        first = self.browser.find_element(By.CSS_SELECTOR, "main > figure")
        self.assertLess(first.location["y"], self.browser.find_element(By.TAG_NAME, "table").location["y"])
        self.assertEqual([item.text for item in first.find_elements(By.CSS_SELECTOR, ".legend li")], ["run", "other"])
        inks = self.browser.execute_script("""
            const canvas = document.querySelector("main > figure canvas"), context = canvas.getContext("2d");
            const { data } = context.getImageData(0, 0, canvas.width, canvas.height), seen = {};
            for (let k = 0; k < data.length; k += 4) if (data[k + 3] === 255) {
              const key = `rgb(${data[k]}, ${data[k + 1]}, ${data[k + 2]})`;
              seen[key] = (seen[key] ?? 0) + 1;
            }
            return [...document.querySelectorAll(".legend span")].map((e) => seen[getComputedStyle(e).backgroundColor] ?? 0);""")
        self.assertTrue(all(count > 100 for count in inks), inks)
        again = subprocess.run([program, "report", self.folder / "run", "--output", page], check=False,
                               capture_output=True)
        self.assertEqual(again.returncode, 4)


class RemarksPage(Browser, unittest.TestCase):
    """The page of a caster that became lighter, but whose run-out and strain grew."""

    case = """
[wheel]
inner_radius = 0.025
outer_radius = 0.0625
width = 0.032
sectors = 10
[material]
youngs_modulus = 60e6
poissons_ratio = 0.45
density = 1200
[load]
mass = 80
positions = 2
[[holes.ring]]
count = 10
center_radius = 0.043
radius = 0.009
[grid]
radial_cells = 14
angular_cells = 120
tread_levels = 1
[optimizer]
iterations = 20
tread_band = 0.0055
rim_band = 0.003
[objective]
minimize = "mass"
[[constraint]]
quantity = "stiffness"
at_least = "700 N/mm"
"""

    def test_the_bounds_of_remarks_can_be_pasted_into_the_case(self):
        self.open(self.page)
        lines = [block.text for block in self.browser.find_elements(By.CSS_SELECTOR, "#run0-flags pre")]
        self.assertEqual(lines, [remark["constraint"] for remark in self.summary["remarks"] if remark["constraint"]])
        self.assertTrue(lines)
        case = self.folder / "bounded.toml"
        case.write_text(self.case + "\n".join(lines) + "\n")
        run_program("check", case)


class LoadsPage(Browser, unittest.TestCase):
    """The page of a wheel with several loads and bounds."""

    case = LOADS_CASE

    def test_each_bound_has_its_limit_values_margin_and_multiplier(self):
        self.open(self.page)
        with open(self.folder / "run/history.csv", newline="") as file:
            first = next(csv.DictReader(file))
        bounds = self.summary["bounds"]
        self.assertEqual(len(bounds), 4)
        self.assertGreater(max(bound["multiplier"] for bound in bounds), 0)
        shown = {"stiffness": ("N/mm", 1e-3 * self.summary["width_m"]), "run_out": ("mm", 1e3)}
        for bound in bounds:
            unit, factor = shown[bound["name"].split()[0]]
            row = self.browser.find_element(By.CSS_SELECTOR, f"tr[data-bound='{bound['name']}']")
            limit, before, after, margin, percent, state, multiplier = (cell.text for cell in
                                                                       row.find_elements(By.TAG_NAME, "td"))
            self.assertIn(f"[{unit}]", row.text)
            (column,) = [name for name in first if name.startswith(f"bounded {bound['name']} [")]
            sign = 1 if bound["relation"] == ">" else -1
            for text, value in ((limit.split()[-1], bound["bound"] * factor), (before, float(first[column]) * factor),
                                (after, bound["value"] * factor),
                                (margin, sign * (bound["value"] - bound["bound"]) * factor),
                                (percent, sign * 100 * (bound["value"] / bound["bound"] - 1)),
                                (multiplier.split()[0], bound["multiplier"] * self.summary["width_m"] / factor)):  # kg of mass
                self.assertAlmostEqual(float(text.replace("\u2212", "-")), value, delta=1e-3 * abs(value), msg=bound["name"])
            self.assertEqual(state.split(",")[0], "active" if bound["multiplier"] else "not active")
        self.assertIn("4 bounds are kept", self.text("run0-verdict"))

    def test_the_load_and_the_mass_are_those_of_the_whole_width(self):
        self.open(self.page)
        run = json.loads(self.browser.execute_script("return document.getElementById('data').textContent"))["runs"][0]
        value, unit = run["load"].split()
        self.assertEqual(unit, "N")
        self.assertAlmostEqual(float(value), self.summary["before"]["load_N"], delta=1e-5 * float(value))
        value = float(re.search(r"objective \[kg\] ([\d.]+)", self.text("run0-shape-text"))[1])
        self.assertAlmostEqual(value, self.summary["after"]["mass_kg"], delta=1e-3 * value)

    def test_each_load_has_its_numbers_and_its_picture(self):
        self.open(self.page)
        after = self.summary["after"]
        travels = [shown_value(cell.text) for cell in
                   self.browser.find_elements(By.CSS_SELECTOR, "td[data-key=mean_travel_m]")]
        told = [wheel["mean_travel_m"] * 1e3 for numbers in (
            [self.summary["before"], after],
            [self.summary[when]["load_cases"]["kerb"] for when in ("before", "after")]) for wheel in numbers]
        self.assertEqual(len(travels), 4)
        for shown_one, told_one in zip(travels, told):
            self.assertAlmostEqual(shown_one, told_one, delta=0.02 * told_one)
        self.assertIn("straight", self.text("run0-position-text"))
        self.assertIn("kerb", self.text("run0-load1-position-text"))
        self.assertNotEqual(self.pixels("run0-position"), self.pixels("run0-load1-position"))
        slider = self.browser.find_element(By.ID, "run0-load1-position")
        seen = self.pixels("run0-load1-position")
        slider.send_keys(Keys.ARROW_RIGHT)
        self.assertNotEqual(self.pixels("run0-load1-position"), seen)


    def test_the_wheels_of_two_loads_and_their_shape_stand_in_one_row(self):
        self.open(self.page)
        figures = self.browser.find_elements(By.CSS_SELECTOR, ".wheels > figure")
        self.assertEqual(len(figures), 3)
        self.assertEqual(len({figure.location["y"] for figure in figures}), 1)


class SolidPage(Browser, unittest.TestCase):
    """The page of a run in 3D: a lit surface that turns."""

    case = SOLID_CASE

    def picture(self):
        return self.browser.find_element(By.ID, "run0-position-text").find_element(By.XPATH, "..").find_element(By.TAG_NAME, "canvas")

    def pixels_of_surface(self):
        return self.browser.execute_script("return arguments[0].toDataURL()", self.picture())

    def test_the_surface_is_lit_and_coloured(self):
        self.open(self.page)
        colours = self.browser.execute_script("""
            const canvas = arguments[0], copy = document.createElement("canvas");
            [copy.width, copy.height] = [canvas.width, canvas.height];
            const context = copy.getContext("2d");
            context.drawImage(canvas, 0, 0);
            const data = context.getImageData(0, 0, copy.width, copy.height).data, found = new Set();
            let covered = 0;
            for (let k = 0; k < data.length; k += 4) if (data[k + 3] === 255) {
              ++covered;
              found.add(data[k] << 16 | data[k + 1] << 8 | data[k + 2]);
            }
            return [found.size, covered / (data.length / 4)];""", self.picture())
        self.assertGreater(colours[0], 200)
        self.assertTrue(0.2 < colours[1] < 0.8, colours)

    def test_it_turns_under_the_mouse_and_by_keyboard(self):
        self.open(self.page)
        before = self.pixels_of_surface()
        ActionChains(self.browser).drag_and_drop_by_offset(self.picture(), 60, 20).perform()
        turned = self.pixels_of_surface()
        self.assertNotEqual(turned, before)
        self.picture().send_keys(Keys.ARROW_LEFT)
        further = self.pixels_of_surface()
        self.assertNotEqual(further, turned)
        self.picture().send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(self.pixels_of_surface(), turned)
        self.picture().send_keys("+")
        self.assertNotEqual(self.pixels_of_surface(), turned)

    def test_colours_stand_for_stress_or_displacement(self):
        self.open(self.page)
        figure = self.browser.find_element(By.ID, "run0-position-text").find_element(By.XPATH, "..")
        stress, scale = self.pixels_of_surface(), figure.find_element(By.CLASS_NAME, "scale-labels").text
        self.assertIn("MPa", scale)
        Select(self.browser.find_element(By.ID, "run0-colours")).select_by_value("displacement")
        self.assertNotEqual(self.pixels_of_surface(), stress)
        end = float(re.search(r"([\d.]+) mm", figure.find_element(By.CLASS_NAME, "scale-labels").text)[1])
        # No point moves much farther than the rim, and some as far.
        travel = 1e3 * self.summary["after"]["mean_travel_m"]
        self.assertTrue(0.8 * travel < end < 2 * travel, (end, travel))

    def test_load_positions_differ(self):
        self.open(self.page)
        first = self.pixels_of_surface()
        self.browser.find_element(By.ID, "run0-position").send_keys(Keys.ARROW_RIGHT)
        self.assertNotEqual(self.pixels_of_surface(), first)

    def test_a_plane_run_and_a_solid_one_stand_on_one_page(self):
        (self.folder / "plane.toml").write_text(CASE)
        run_program("run", self.folder / "plane.toml", "--output", self.folder / "plane", "--iterations", 1)
        run_program("report", self.folder / "run", self.folder / "plane", "--output", self.folder / "both.html")
        self.open(self.folder / "both.html")
        self.assertEqual([e for e in self.browser.get_log("browser") if e["level"] == "SEVERE"], [])
        self.assertEqual(len(self.browser.find_elements(By.TAG_NAME, "article")), 2)


class FailedPage(unittest.TestCase):
    """The page of a run whose first shape could not be computed."""

    def test_it_says_why_there_is_no_wheel(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "case.toml").write_text(FAILING_CASE)
            ended = subprocess.run([program, "run", folder / "case.toml", "--output", folder / "run"], check=False,
                                   capture_output=True)
            self.assertEqual(ended.returncode, 3)
            browser = support.open_browser(1200, 900)
            self.addCleanup(browser.quit)
            browser.get(f"file://{folder}/run/report.html")
            self.assertEqual([e for e in browser.get_log("browser") if e["level"] == "SEVERE"], [])
            reason = (folder / "run/failure/report.txt").read_text().splitlines()[0]
            self.assertIn("disconnected", reason)
            self.assertIn(reason, browser.find_element(By.ID, "run0-flags").text)
            self.assertIn("could not be computed", browser.find_element(By.ID, "run0-status").text)


if __name__ == "__main__":
    unittest.main()
