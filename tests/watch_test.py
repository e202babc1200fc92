"""Tests of the page of `wheelwright watch` in a browser. usage: watch_test.py PROGRAM, from the repository's top folder."""

import contextlib
import http.client
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import support

support.skip_without_browser()

from selenium.common.exceptions import StaleElementReferenceException
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import design_on_page

program = sys.argv.pop(1)

CASE = """
title = '''</title><script>document.title = "broken out"</script>'''
[wheel]
sectors = 8
[load]
positions = 4
[[holes.ring]]
count = 8
center_radius = 0.27
radius = 0.03
[grid]
radial_cells = 8
angular_cells = 96
tread_levels = 0
[optimizer]
rim_band = 0.0175
tread_band = 0.035
minimum_wall = 0.017
minimum_gap = 0.0175
"""


class Watched:
    """A run that is watched, without a browser."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([program, "watch", *map(str, arguments), "--no-browser", "--threads", "1"],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        env=support.one_thread_each())
        self.address = self.process.stdout.readline().strip()
        self.base, self.token = self.address.split("/#")

    def connect(self):
        return http.client.HTTPConnection(self.base.removeprefix("http://"), timeout=180)

    def ask(self, method, path, body=None):
        with contextlib.closing(self.connect()) as connection:
            connection.request(method, path, body, {"Authorization": f"Bearer {self.token}"})
            return connection.getresponse().read()

    def get(self, path):
        return self.ask("GET", path)

    def frame(self, path="/frame?after=0"):
        return json.loads(self.get(path))

    def give(self, command):
        return json.loads(self.ask("POST", "/command", json.dumps(command)))

    def wait(self, wanted):
        version, until = 0, time.time() + 180
        while time.time() < until:
            frame = self.frame(f"/frame?after={version}")
            if wanted(frame):
                return frame
            version = frame["version"]
        raise TimeoutError

    def errors(self):
        """The estimate of errors that is in progress, as soon as it ends."""
        while (answer := json.loads(self.get("/errors")))["busy"]:
            pass
        return answer["estimate"]

    def end(self, number=signal.SIGINT):
        if self.process.poll() is None:
            self.process.send_signal(number)
        output = self.process.communicate(timeout=180)
        return self.process.returncode, *output


def command_lines():
    """Those of all processes."""
    for file in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            yield file.read_bytes().decode(errors="replace")


class PageTest(unittest.TestCase):
    """A page of a run in a browser."""

    case = CASE
    arguments = []

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = Path(cls.temporary.name)
        (cls.folder / "case.toml").write_text(cls.case)
        cls.browser = support.open_browser(1440, 900)
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        self.watched = Watched(self.folder / "case.toml", "--output", self.folder / self._testMethodName,
                               *self.arguments)
        self.addCleanup(self.watched.end)
        self.browser.get("about:blank")
        self.browser.get_log("browser")
        self.browser.get_log("performance")
        self.browser.get(self.watched.address)
        self.until(lambda: self.wheel("painted"))

    def tearDown(self):
        # Of this page: one of the test before may ask its server once more, which has ended.
        severe = [entry for entry in self.browser.get_log("browser")
                  if entry["level"] == "SEVERE" and self.watched.base in entry["message"]]
        self.assertEqual(severe, [])

    def until(self, wanted, seconds=180):
        end = time.time() + seconds
        while True:
            found = wanted()
            if found or time.time() > end:
                self.assertTrue(found)
                return found
            time.sleep(0.02)

    def element(self, name):
        return self.browser.find_element(By.ID, name)

    def text(self, name):
        while True:
            try:
                return self.element(name).text
            except StaleElementReferenceException:
                pass  # the page has written its numbers anew in between

    def type(self, name, text):
        self.element(name).send_keys(Keys.CONTROL, "a", Keys.NULL, text, Keys.ENTER)

    def wheel(self, name):
        return self.element("wheel").get_attribute(f"data-{name}")

    def picture(self):
        return self.browser.execute_script("return document.getElementById('wheel').toDataURL()")

    def still(self):
        """Stops the rolling, so that a picture changes by what a test does."""
        if self.element("roll").get_attribute("aria-pressed") == "true":
            self.element("roll").click()
        self.element("position").send_keys(Keys.HOME)
        self.shows_position(0)

    def shows_position(self, position):
        """Waits until the newest shape is painted there."""
        shape = self.watched.frame()["shape"]
        self.until(lambda: (self.loaded("position"), self.loaded("shape")) == (str(position), str(shape)))

    def loaded(self, name):
        return self.element("loaded-wheel").get_attribute(f"data-{name}")

    def settled(self):
        self.until(lambda: "no better shape" in self.text("state"))

    def paused(self):
        """Pauses, also where the run waits because it settled."""
        self.watched.give({"do": "pause"})
        self.until(lambda: self.text("go") == "Continue")


class Page(PageTest):
    """The page of a plane wheel."""

    def test_the_page_asks_nobody_else_and_shows_no_token(self):
        self.settled()
        self.assertEqual(self.browser.current_url, self.watched.base + "/")
        self.assertNotIn(self.watched.token, self.browser.page_source)
        messages = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        urls = {m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"}
        self.assertTrue(all(u.startswith((self.watched.base, "data:")) for u in urls), urls)
        self.assertFalse([u for u in urls if self.watched.token in u])
        self.assertNotEqual(self.browser.title, "broken out")

    def test_the_token_is_in_no_process_list_and_no_log(self):
        for command in command_lines():
            self.assertNotIn(self.watched.token, command)
        self.watched.give({"do": "pause"})
        self.browser.get("about:blank")  # the page would tell that the server is gone
        code, _, messages = self.watched.end()
        self.assertEqual(code, 130)
        self.assertNotIn(self.watched.token, messages)
        for file in (self.folder / self._testMethodName).rglob("*"):
            if file.is_file():
                self.assertNotIn(self.watched.token.encode(), file.read_bytes(), file)

    def test_the_wheel_improves_while_one_watches(self):
        self.settled()
        frame = self.watched.frame()
        self.assertEqual(self.wheel("shape"), str(frame["shape"]))
        self.assertEqual(self.text("number-shape"), str(frame["shape"]))
        objective = [point[1] for point in frame["curve"]]
        self.assertLess(objective[-1], 0.95 * objective[0])
        self.assertAlmostEqual(float(self.text("number-objective").split()[0]), objective[-1], delta=1e-4 * objective[-1])
        # The curves show the last shape too.
        self.until(lambda: self.browser.execute_script(
            "return Chart.getChart(document.querySelector('#charts canvas')).data.datasets[0].data.length") ==
            len(objective))

    def test_pause_step_and_go_on_by_mouse_and_keyboard(self):
        self.settled()
        self.element("go").click()
        self.until(lambda: self.text("state") == "paused")
        self.element("reset").click()
        self.until(lambda: self.element("undo").is_enabled())
        at = int(self.watched.frame()["shape"])
        for k, press in enumerate((lambda: self.element("step").click(),
                                   lambda: self.element("step").send_keys(Keys.ENTER))):
            press()
            self.until(lambda k=k: self.wheel("shape") == str(at + k + 1))
            self.until(lambda: "paused" in self.text("state"))
        self.element("go").send_keys(Keys.SPACE)
        self.settled()
        self.assertGreater(int(self.wheel("shape")), at + 2)

    def test_reset_and_undo(self):
        self.settled()
        first = self.watched.frame()["curve"][0]
        last = self.watched.frame()
        self.assertFalse(self.element("undo").is_enabled())
        self.paused()
        self.element("reset").click()
        back = self.watched.wait(lambda f: f["can_undo"])
        self.assertEqual(back["numbers"]["objective_J_per_m"], first[1])
        self.until(lambda: self.element("undo").is_enabled())
        self.still()
        initial = self.picture()
        self.element("undo").click()
        again = self.watched.wait(lambda f: not f["can_undo"])
        self.assertEqual(again["outline"], last["outline"])
        self.until(lambda: self.picture() != initial)
        self.assertEqual(again["numbers"]["objective_J_per_m"], last["numbers"]["objective_J_per_m"])

    def test_the_load_follows_its_slider_and_its_number(self):
        self.settled()
        before = self.watched.frame()
        slider, number = self.element("force"), self.element("force-number")
        slider.send_keys(Keys.ARROW_RIGHT)
        wanted = float(number.get_attribute("value"))
        self.assertGreater(wanted, before["settings"]["load"]["force_N"])
        self.watched.wait(lambda f: f["settings"]["load"]["force_N"] == wanted)
        self.type("force-number", "6000")
        after = self.watched.wait(lambda f: f["settings"]["load"]["force_N"] == 6000)
        self.assertGreater(after["numbers"]["mean_travel"], 1.5 * before["numbers"]["mean_travel"])
        self.until(lambda: self.text("message").startswith("new load"))
        # The curve of the objective has no values of another load.
        self.settled()
        curve = self.watched.frame("/frame?after=0&curve=0")["curve"]
        of_this_load = [point[1] for point in curve if point[5] == curve[-1][5]]
        self.assertLess(len(of_this_load), len(curve))
        self.assertGreater(of_this_load[0], 2 * curve[0][1])
        self.until(lambda: self.browser.execute_script(
            "return Chart.getChart(document.querySelector('#charts canvas')).data.datasets[0].data.map((p) => p.y)") ==
            of_this_load)
        self.type("force-number", "-5")
        self.until(lambda: "refused" in self.element("message").get_attribute("class"))
        self.assertIn("force", self.text("message"))
        self.assertEqual(self.watched.frame()["settings"]["load"]["force_N"], 6000)
        self.until(lambda: float(self.element("force-number").get_attribute("value")) == 6000)

    def test_volume_and_weights_follow_their_sliders(self):
        self.settled()
        self.type("volume-number", "88")
        self.watched.wait(lambda f: abs(f["numbers"]["volume_fraction"] - 0.88) < 1e-6)
        self.settled()
        self.element("even").send_keys(Keys.END)
        numbers = self.watched.wait(lambda f: f["settings"]["weights"]["uniformity_dual"] == 1e5)["numbers"]
        weighted = numbers["strain_energy"] + 1e5 * numbers["uniformity_dual"]
        self.assertAlmostEqual(numbers["objective_J_per_m"], weighted, delta=1e-9 * weighted)

    def test_a_slider_that_is_dragged_does_not_lag(self):
        self.settled()
        slider = self.element("force")
        ActionChains(self.browser).drag_and_drop_by_offset(slider, 60, 0).perform()
        wanted = float(self.element("force-number").get_attribute("value"))
        self.watched.wait(lambda f: f["settings"]["load"]["force_N"] == wanted)

    def test_walls_and_bounds_follow_their_sliders(self):
        self.settled()
        self.type("wall-number", "12")
        self.watched.wait(lambda f: f["settings"]["minimum_wall_m"] == 0.012)
        self.element("wall").send_keys(Keys.HOME)
        self.watched.wait(lambda f: f["settings"]["minimum_wall_m"] == 0)
        self.type("gap-number", "1000")
        self.until(lambda: "refused" in self.element("message").get_attribute("class"))
        self.assertIn("the ring is only", self.text("message"))

    def test_the_load_position_is_chosen(self):
        self.settled()
        pressure = "return JSON.stringify(Chart.getChart(document.querySelectorAll('#charts canvas')[2]).data.datasets[0].data)"
        self.still()
        pressures = []
        for position in range(3):
            self.until(lambda p=position: self.browser.execute_script(
                "return document.getElementById('position').value") == str(p))
            pressures.append(self.until(lambda: next((drawn for drawn in [self.browser.execute_script(pressure)]
                                                      if drawn not in pressures), None)))
            self.element("position").send_keys(Keys.ARROW_RIGHT)

    def test_two_pages_and_a_reload_see_the_same(self):
        self.settled()
        self.browser.refresh()
        self.until(lambda: self.wheel("painted"))
        shape = self.wheel("shape")
        one = self.browser.current_window_handle
        self.browser.switch_to.new_window("tab")
        self.browser.get(self.watched.address)
        self.until(lambda: self.wheel("painted"))
        self.assertEqual(self.wheel("shape"), shape)
        self.element("reset").click()
        self.until(lambda: int(self.wheel("version")) > 0 and self.element("undo").is_enabled())
        self.browser.close()
        self.browser.switch_to.window(one)
        self.until(lambda: self.element("undo").is_enabled())

    def test_a_page_without_the_token_says_what_to_do(self):
        self.browser.switch_to.new_window("tab")
        self.browser.get(self.watched.base + "/")
        self.until(lambda: "open the address" in self.text("state"))
        self.assertEqual([e for e in self.browser.get_log("browser") if e["level"] == "SEVERE" and "401" not in e["message"]], [])
        self.browser.close()
        self.browser.switch_to.window(self.browser.window_handles[0])

    def drag(self, start, end=None):
        """The mouse on the wheel, from one place to another, in metres."""
        wheel, first = self.element("wheel"), design_on_page.offset(self, start)
        actions = ActionChains(self.browser, duration=20)
        actions.move_to_element_with_offset(wheel, *first).click_and_hold()
        if end:
            last = design_on_page.offset(self, end)
            actions.move_by_offset(last[0] - first[0], last[1] - first[1])
        actions.release().perform()

    def changed(self, act):
        """The volume before and after something that the user does to a paused wheel."""
        before = self.watched.frame()
        act()
        after = self.watched.wait(lambda f: not f["is_proposed"] and
                                  (f["message"] != before["message"] or f["outline"] != before["outline"]))
        self.assertFalse(after["is_refusal"], after["message"])
        self.until(lambda: int(self.wheel("version")) >= after["version"])
        return before, self.watched.frame()

    def test_holes_are_edited_by_mouse(self):
        self.settled()
        self.paused()
        self.element("reset").click()
        self.until(lambda: self.element("undo").is_enabled())
        hole = (0.27 * 0.92387953, 0.27 * 0.38268343)
        volume = lambda frames: [f["numbers"]["volume_fraction"] for f in frames]
        self.still()
        picture = self.picture()
        self.element("tool-move").click()
        before, after = self.changed(lambda: self.drag(hole, (hole[0] - 0.012, hole[1] + 0.004)))
        self.assertTrue(after["message"].startswith("the hole at"))
        self.assertAlmostEqual(*volume((before, after)), delta=2e-3)
        self.assertNotEqual(after["travel_m"], before["travel_m"])
        self.assertNotEqual(self.picture(), picture)
        self.element("undo").click()
        self.watched.wait(lambda f: f["outline"] == before["outline"])
        self.element("tool-resize").click()
        resized = self.changed(lambda: self.drag((hole[0] + 0.02, hole[1]), (hole[0] + 0.01, hole[1])))
        first, second = volume(resized)
        self.assertGreater(second, first + 0.01)
        self.assertNotIn("moved", resized[1]["message"])
        self.element("tool-fill").click()
        first, second = volume(self.changed(lambda: self.drag(hole)))
        self.assertGreater(second, first)
        between = (0.27, 0.0)
        for tool, sign in (("add", -1), ("paint", 1), ("erase", -1)):
            self.element(f"tool-{tool}").click()
            frames = self.changed(lambda: self.drag(between, (between[0], between[1] + 0.015)))
            first, second = volume(frames)
            self.assertGreater(sign * (second - first), 1e-3, tool)
            # Only one of the tools tells of a hole; the others say what they did to the material.
            self.assertEqual("hole" in frames[1]["message"], tool == "add", frames[1]["message"])
            self.assertEqual("material" in frames[1]["message"], tool != "add", frames[1]["message"])

    def test_holes_are_edited_by_keyboard(self):
        self.settled()
        self.paused()
        self.element("reset").click()
        self.until(lambda: self.element("undo").is_enabled())
        self.element("tool-look").send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(self.element("tool-move").get_attribute("aria-pressed"), "true")
        self.assertEqual(self.element("tool-look").get_attribute("aria-pressed"), "false")
        self.still()
        wheel = self.element("wheel")
        wheel.send_keys(Keys.ARROW_LEFT)  # the cross appears in the first hole
        before, after = self.changed(
            lambda: wheel.send_keys(Keys.ENTER, Keys.ARROW_DOWN, Keys.ARROW_DOWN, Keys.ENTER))
        self.assertTrue(after["message"].startswith("the hole at"))
        self.assertNotEqual(before["outline"], after["outline"])
        version = self.watched.frame()["version"]
        wheel.send_keys(Keys.ENTER, Keys.ARROW_UP, Keys.ESCAPE)
        self.assertEqual(self.watched.frame()["version"], version)

    def test_the_loaded_wheel_rolls_and_stops(self):
        self.settled()
        seen, places = set(), set()
        look = "return document.getElementById('loaded-wheel').toDataURL()"
        self.until(lambda: seen.add(self.browser.execute_script(look)) or places.add(self.loaded("position")) or
                   (len(seen) >= 4 and len(places) >= 4))
        self.assertEqual(self.element("roll").get_attribute("aria-pressed"), "true")
        self.still()
        self.assertEqual(self.element("roll").get_attribute("aria-pressed"), "false")
        loaded = self.browser.execute_script(look)
        self.assertEqual(self.loaded("position"), "0")
        self.element("load").click()  # without its displacements
        self.assertNotEqual(self.browser.execute_script(look), loaded)
        self.element("load").click()
        self.assertEqual(self.browser.execute_script(look), loaded)

    def test_errors_are_estimated_on_demand(self):
        self.settled()
        self.paused()
        shape = str(self.watched.frame()["shape"])
        self.assertNotIn("\u00b1", self.text("numbers"))
        self.element("estimate").send_keys(Keys.ENTER)
        for name in ("objective", "travel", "stiffness_N_per_m", "peak_von_mises_Pa"):
            self.until(lambda name=name: re.fullmatch(r"[\d.]+ \u00b1 [\d.]+", self.text(f"number-{name}")))
        value, error = self.text("number-travel").split(" \u00b1 ")
        self.assertEqual(value.partition(".")[2], value.partition(".")[2].ljust(len(error.partition(".")[2]), "0"))
        self.assertNotIn("\u00b1", self.text("number-minimum_wall_m"))  # measured on the outline
        self.assertEqual(self.browser.execute_script(
            "const e = document.querySelector('.facts'); return e.scrollWidth - e.clientWidth"), 0)
        told = self.text("errors-text")
        self.assertRegex(told, rf"shape {shape}, estimated in [\d.]+ s$")
        # They stay those of this shape.
        self.element("reset").click()
        self.until(lambda: self.text("errors-text") != told)
        self.assertRegex(self.text("errors-text"), rf"shape {shape}, estimated in .* changed")
        self.until(lambda: "\u00b1" not in self.text("numbers"))
        self.element("errors-text").click()
        self.until(lambda: f"{value} \u00b1 {error}" in self.text("errors"))
        # Another page sees them too.
        self.browser.refresh()
        self.until(lambda: f"shape {shape}," in self.text("errors-text"))

    def test_designs_are_taken_away(self):
        self.settled()
        self.paused()
        self.element("reset").click()
        self.until(lambda: self.element("undo").is_enabled())
        self.element("name").send_keys(Keys.CONTROL, "a", Keys.NULL, "even-wheel")
        self.element("save").click()
        self.until(lambda: self.text("message").startswith("saved"))
        self.element("save").click()
        self.until(lambda: "already" in self.text("message"))
        self.browser.get_log("browser")  # a refusal is an answer of its own status
        self.element("export").send_keys(Keys.ENTER)
        self.until(lambda: "even-wheel.step is downloaded" in self.text("message"))
        self.element("report").click()
        self.until(lambda: "even-wheel.html is downloaded" in self.text("message"))

    def test_controls_have_names(self):
        for control in self.browser.find_elements(By.CSS_SELECTOR, "input, select, button, canvas:not([aria-hidden])"):
            if control.is_displayed():
                self.assertTrue(control.accessible_name, control.get_attribute("outerHTML"))
        self.assertEqual(self.browser.find_element(By.TAG_NAME, "html").get_attribute("lang"), "en")

    def test_the_focus_reaches_every_control(self):
        self.settled()
        wanted = {e.get_attribute("id") for e in self.browser.find_elements(
            By.CSS_SELECTOR, "input, select, button, [tabindex]") if e.is_enabled() and e.is_displayed()}
        self.browser.execute_script("document.activeElement.blur()")
        seen = set()
        for _ in range(3 * len(wanted)):
            ActionChains(self.browser).send_keys(Keys.TAB).perform()
            seen.add(self.browser.switch_to.active_element.get_attribute("id"))
        self.assertLessEqual(wanted, seen)


class BoundedPage(PageTest):
    """The page of a wheel with a bound, and of designs to choose from."""

    case = CASE + """
[[constraint]]
quantity = "mean_travel"
at_most = 1e-3
"""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        case = cls.folder / "sweep.toml"
        case.write_text(CASE + "iterations = 3\n")
        support.run_program(program, "sweep", case, "objective.uniformity_dual=0,1e5", "--output", cls.folder / "designs")
        cls.arguments = ["--designs", cls.folder / "designs"]

    def test_the_labels_of_the_legend_have_room(self):
        self.until(lambda: self.element("legend").is_displayed())
        labels = self.browser.execute_script("""
            return [...document.getElementById("scale-labels").children].map((e) =>
                [e.textContent, e.scrollWidth - e.clientWidth, e.clientHeight])""")
        self.assertGreater(len(labels), 1)
        for text, hidden, height in labels:
            self.assertLessEqual(hidden, 1, text)
            self.assertGreater(height, 8, text)

    def test_designs_stand_still_while_numbers_appear(self):
        self.until(lambda: self.element("designs").is_displayed())
        before = self.element("front").rect
        self.browser.execute_script("""
            const more = document.createElement("div");
            more.id = "more";
            more.style = "flex: none; height: 200px";
            document.getElementById("numbers").before(more);""")
        self.assertEqual(self.element("front").rect, before)
        self.browser.execute_script("document.getElementById('more').remove()")

    def test_a_bound_follows_its_slider(self):
        self.assertIn("[mm]", self.browser.find_element(By.CSS_SELECTOR, "label[for='bound-0-at_most']").text)
        self.type("bound-0-at_most-number", "0.9")
        self.watched.wait(lambda f: [bound["quantity"] for bound in f["settings"]["bounds"]] == ["mean_travel"] and
                          abs(f["settings"]["bounds"][0]["at_most"] / 9e-4 - 1) < 1e-12)
        self.until(lambda: "new bound" in self.text("message"))
        self.element("bound-0-at_most").send_keys(Keys.ARROW_RIGHT)
        self.watched.wait(lambda f: f["settings"]["bounds"][0]["at_most"] > 9e-4)

    def choose(self, design):
        """Clicks on a design's point in the chart, which moves while rows of numbers beside it appear; returns its name."""
        front = self.element("front")

        def is_chosen():
            size = front.size
            x, y = self.browser.execute_script(
                "const p = Chart.getChart('front').getDatasetMeta(0).data[arguments[0]]; return [p.x, p.y]", design)
            ActionChains(self.browser).move_to_element_with_offset(
                front, round(x - size["width"] / 2), round(y - size["height"] / 2)).click().perform()
            return self.element("design").get_attribute("value") == name

        name = self.browser.execute_script(
            "const list = document.getElementById('design'); list.selectedIndex = -1; return list.options[arguments[0]].value",
            design)
        self.until(is_chosen)
        return name

    def test_a_design_is_chosen_by_mouse_and_keyboard(self):
        self.until(lambda: self.element("designs").is_displayed())
        self.paused()
        own = self.watched.frame()["outline"]
        outlines = []
        for design in range(2):
            name = self.choose(design)
            self.until(lambda name=name: f"designs/{name}/" in self.text("message"))
            before = outlines[-1] if outlines else own
            outlines.append(self.watched.wait(lambda f, before=before: f["outline"] != before)["outline"])
        self.assertNotEqual(outlines[0], outlines[1])
        self.assertNotIn(own, outlines)
        self.element("design").send_keys(Keys.ARROW_UP)
        self.element("take").send_keys(Keys.ENTER)
        self.watched.wait(lambda f: f["outline"] == outlines[0] and not f["is_proposed"])
        undone = 0
        while self.watched.give({"do": "undo"})["executed"]:
            undone += 1
        self.assertGreaterEqual(undone, 3)
        self.watched.wait(lambda f: f["outline"] == own and not f["is_proposed"])

    def test_a_page_names_designs_and_no_files(self):
        file = str(self.folder / "designs/designs/001/shape.levelset")
        self.assertFalse(self.watched.give({"do": "take_shape", "file": file})["executed"])
        for name in (file, "../designs/001", "", "/etc/passwd"):
            self.assertFalse(json.loads(self.watched.ask("POST", "/take", name))["executed"], name)


SOLID_CASE = """
[wheel]
dimension = 3
sectors = 8
[load]
positions = 2
[[holes.ring]]
count = 8
center_radius = 0.26
radius = 0.025
[grid]
radial_cells = 7
angular_cells = 64
axial_cells = 2
tread_levels = 0
[optimizer]
rim_band = 0.02
tread_band = 0.04
"""


TWO_LOADS = CASE + """
[material]
density = 1100
[[constraint]]
quantity = "stiffness"
at_least = 1e6
[[constraint]]
quantity = "peak_von_mises"
at_most = 1e5
[[load.case]]
name = "straight"
[[load.case]]
name = "kerb"
force = 5000
"""

SIZES = [(1440, 900), (1280, 720)]


class OneScreen(PageTest):
    """The page as one screen, of a wheel with two loads and two bounds."""

    case = TWO_LOADS

    def resize(self, width, height):
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def pixels(self):
        """The lowest painted row of the loaded wheel and the places painted in it, and the size of the canvas."""
        return self.browser.execute_script("""
            const picture = document.getElementById("loaded-wheel"), copy = document.createElement("canvas");
            [copy.width, copy.height] = [picture.width, picture.height];
            const context = copy.getContext("2d");
            context.drawImage(picture, 0, 0);
            const data = context.getImageData(0, 0, copy.width, copy.height).data;
            for (let y = copy.height - 1; y >= 0; --y) {
              const row = [];
              for (let x = 0; x < copy.width; ++x) if (data[4 * (y * copy.width + x) + 3] > 200) row.push(x);
              if (row.length > 0) return [y, row[0], row.at(-1), copy.width, copy.height];
            }
            return null;""")

    def test_all_is_seen_without_scrolling(self):
        self.until(lambda: self.element("bounds").is_displayed())
        self.until(lambda: self.browser.find_elements(By.ID, "number-minimum_wall_m"))
        seen = ["wheel", "go", "step", "undo", "reset", "state", "loads", "load", "roll", "ghost", "position", "fit", "zoom-in",
                "force", "volume", "even", "wall", "bound-0-at_least", "bound-1-at_most", "charts", "numbers", "bounds", "name",
                "save", "export", "report", "number-objective", "number-mass_kg", "number-stiffness_N_per_m", "number-run-out",
                "number-minimum_wall_m", "number-minimum_gap_m", "number-peak_von_mises_Pa", "number-largest_strain",
                *(f"tool-{tool}" for tool in ("look", "move", "resize", "add", "fill", "paint", "erase"))]
        for width, height in SIZES:
            self.resize(width, height)
            time.sleep(0.5)
            root, boxes = self.browser.execute_script("""
                const e = document.documentElement, box = (id) => document.getElementById(id).getBoundingClientRect();
                return [[e.scrollWidth, e.scrollHeight], arguments[0].map((id) => [id, box(id).left, box(id).top, box(id).right, box(id).bottom])];
                """, seen)
            self.assertLessEqual(root[0], width)
            self.assertLessEqual(root[1], height)
            for name, left, top, right, bottom in boxes:
                self.assertGreater(right - left, 4, name)
                self.assertGreater(bottom - top, 4, name)
                self.assertTrue(left >= 0 and top >= 0 and right <= width and bottom <= height, (name, width, left, top, right, bottom))
            # Nothing is cut off where it stands; only warnings may be scrolled to, below numbers and bounds.
            facts = self.browser.find_element(By.CLASS_NAME, "facts").rect
            self.assertLessEqual(max(bottom for name, *_, bottom in boxes if name in ("numbers", "bounds")), facts["y"] + facts["height"])
            hidden = self.browser.execute_script("""
                return [...document.querySelectorAll("header > p, header > div, .tools, .tools button, .view, .panel, .setting, .row, figcaption")]
                  .filter((e) => e.id !== "message" && (e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1))
                  .map((e) => e.outerHTML.slice(0, 80));""")
            self.assertEqual(hidden, [], (width, height))

    def test_the_buttons_below_the_wheel_fit_on_narrow_screens(self):
        self.settled()
        for width, height in [(1150, 700), (1000, 600)]:
            self.resize(width, height)
            time.sleep(0.5)
            bar = self.browser.find_element(By.CLASS_NAME, "view").rect
            for name in ("load", "roll", "ghost", "position", "position-text", "zoom-out", "zoom-text", "zoom-in", "fit"):
                box = self.element(name).rect
                self.assertGreaterEqual(box["x"], bar["x"], (name, width))
                self.assertLessEqual(box["x"] + box["width"], bar["x"] + bar["width"], (name, width))
                self.assertLessEqual(box["y"] + box["height"], height, (name, width))
        self.resize(*SIZES[0])

    def test_the_wheel_stands_on_its_ground(self):
        self.settled()
        self.still()
        for size in SIZES:
            self.resize(*size)
            time.sleep(0.5)
            lowest, left, right, width, height = self.pixels()
            ground = float(self.wheel("ground"))
            self.assertLess(abs(lowest + 1 - ground), 2)
            self.assertLess(ground, height)
            # Its lowest places are the contact, below the axle.
            self.assertLess(abs((left + right) / 2 - width / 2), 0.02 * width)
            self.assertLess(right - left, 0.2 * width)
            # It is as large as it can be.
            self.assertGreater(json.loads(self.wheel("view"))["scale"] * 2 * 0.34, 0.8 * min(width, height))

    def test_zoom_shows_more_of_less(self):
        self.settled()
        self.still()
        fitted, shape, scale = self.pixels(), self.picture(), lambda: json.loads(self.wheel("view"))["scale"]
        first = scale()
        for _ in range(8):
            self.element("zoom-in").click()
        self.assertGreater(scale(), 20 * first)
        self.assertNotEqual(self.picture(), shape)
        self.assertGreater(self.pixels()[2] - self.pixels()[1], 3 * (fitted[2] - fitted[1]))
        self.element("fit").click()
        self.assertEqual(scale(), first)
        self.assertEqual(self.picture(), shape)
        box = self.element("wheel")
        self.browser.execute_script("""arguments[0].dispatchEvent(new WheelEvent("wheel", { deltaY: -400, clientX: 300,
            clientY: 200, bubbles: true, cancelable: true }))""", box)
        self.assertGreater(scale(), 1.5 * first)
        zoomed = self.picture()
        ActionChains(self.browser).move_to_element(box).click_and_hold().move_by_offset(40, 25).release().perform()
        self.assertNotEqual(self.picture(), zoomed)
        box.send_keys("0")
        self.assertEqual(self.picture(), shape)

    def test_the_shape_before_is_a_ghost(self):
        self.settled()
        self.still()
        both = self.picture()
        self.element("ghost").click()
        self.assertNotEqual(self.picture(), both)
        self.element("ghost").click()
        self.assertEqual(self.picture(), both)

    def test_each_load_case_has_its_picture_numbers_and_load(self):
        self.settled()
        self.paused()
        self.still()
        told = lambda: [float(self.text(f"number-{name}")) for name in ("travel", "stiffness_N_per_m", "peak_von_mises_Pa")]
        self.until(lambda: self.text("number-peak_von_mises_Pa"))
        straight, picture = told(), self.pixels()
        self.element("case-1").click()
        self.until(lambda: self.loaded("case") == "1")
        self.until(lambda: "kerb" in self.text("numbers-of") and told()[2] > 1.2 * straight[2])
        self.assertGreater(told()[0], 1.5 * straight[0])
        self.assertGreater(self.pixels()[2] - self.pixels()[1], picture[2] - picture[1])  # of the contact
        self.assertEqual(float(self.element("force-number").get_attribute("value")), 5000)
        self.type("force-number", "6000")
        after = self.watched.wait(lambda f: f["settings"]["load_cases"][1]["load"]["force_N"] == 6000)
        self.assertLess(after["settings"]["load_cases"][0]["load"]["force_N"], 3000)
        self.until(lambda: self.text("message").startswith("new load in kerb"))
        self.element("case-0").click()
        self.until(lambda: told()[0] == straight[0])

    def test_bounds_say_whether_they_are_met(self):
        self.until(lambda: self.element("bounds").is_displayed())
        frame = self.watched.frame()
        rows = self.browser.execute_script(
            "return [...document.querySelectorAll('#bound-rows tr')].map((row) => row.innerText)")
        self.assertEqual(len(rows), len(frame["bounds"]))
        for row, bound in zip(rows, frame["bounds"]):
            self.assertEqual("not met" not in row, bound["is_kept"], row)
        self.assertIn(False, [bound["is_kept"] for bound in frame["bounds"]])

    def test_undo_says_what_it_undid_and_shows_the_numbers_of_that_state(self):
        self.settled()
        self.paused()
        names = ("objective", "travel", "stiffness_N_per_m", "peak_von_mises_Pa", "minimum_wall_m", "minimum_gap_m")
        told = lambda: [self.text(f"number-{name}") for name in names]
        shown = lambda: self.element("numbers").get_attribute("data-version") == str(self.watched.frame()["shape_version"])
        self.until(shown)
        before = told()
        self.element("reset").click()
        self.until(lambda: self.element("undo").is_enabled() and shown())
        self.assertFalse(any(a == b for a, b in zip(told(), before)), (told(), before))
        self.element("undo").click()
        self.until(lambda: self.text("message").startswith("undid: back to the initial shape"))
        self.until(lambda: told() == before, seconds=20)
        self.assertEqual(self.watched.frame()["activity"], "paused")  # no other shape came

    def test_the_terminal_is_quiet(self):
        self.settled()
        self.browser.get("about:blank")  # the page would ask the server that has ended
        code, _, messages = self.watched.end()
        self.assertEqual(code, 130)
        self.assertIn("waiting for changes", messages)
        self.assertNotIn("left", messages)
        self.assertNotIn("1000000", messages)


def height(outline, along):
    """Of a ground's outline, between its places."""
    (a, up_a), (b, up_b) = next(pair for pair in zip(outline, outline[1:]) if pair[0][0] <= along <= pair[1][0] > pair[0][0])
    return up_a + (along - a) / (b - a) * (up_b - up_a)


class OnGrounds(PageTest):
    """A wheel whose load cases are grounds, of which the page shows that of the chosen one."""

    case = CASE + """
[[load.case]]
name = "flat"
[[load.case]]
name = "kerb"
ground = "kerb"
ground_place = 0.06
ground_height = 0.03
ground_radius = 0.01
[[load.case]]
name = "roller"
ground = "drum"
ground_radius = 0.25
"""

    def opacities(self, places):
        """Of the canvas with the ground, at places [along, up] in metres from the axle, that are on it."""
        return self.browser.execute_script("""
            const canvas = document.getElementById("wheel"), ratio = canvas.width / canvas.clientWidth;
            const { scale, x, y } = JSON.parse(canvas.dataset.view), context = canvas.getContext("2d");
            return arguments[0].map(([along, up]) => [ratio * (x + scale * along), ratio * (y - scale * up)])
              .map(([u, v]) => u < 0 || u >= canvas.width || v < 0 || v >= canvas.height ? null :
                context.getImageData(u, v, 1, 1).data[3]);""", places)

    def test_the_ground_is_that_of_the_load_case(self):
        self.settled()
        self.paused()
        self.still()
        step = 0.065  # of the kerb
        places = [0.01 * k for k in range(-40, 41) if abs(0.01 * k - step) > 0.02]
        for k, name in enumerate(("flat", "kerb", "roller")):
            self.element(f"case-{k}").click()
            self.until(lambda k=k: self.loaded("case") == str(k))
            fields = json.loads(self.watched.get(f"/loaded?position=0&case={k}"))["fields"]
            self.assertEqual("ground_m" in fields, name != "flat")
            outline = fields.get("ground_m", [[-4, -0.34], [4, -0.34]])
            if name == "roller":
                places = [along for along in places if abs(along) < 0.25]
                self.assertEqual(self.opacities([[-0.26, -0.36], [0.26, -0.36]]), [0, 0])
            heights = [height(outline, along) for along in places]
            view = json.loads(self.wheel("view"))
            self.assertLess(abs(float(self.wheel("ground")) - (view["y"] - view["scale"] * height(outline, 0))), 2)
            below = self.opacities([[along, up - 0.006] for along, up in zip(places, heights)])
            self.assertEqual(set(below) - {None}, {255}, name)
            self.assertGreater(len([seen for seen in below if seen]), 15)
            beside = [[along, up + 0.006] for along, up in zip(places, heights) if along ** 2 + up ** 2 > 0.35 ** 2]
            self.assertEqual(set(self.opacities(beside)) - {None}, {0}, name)
        # The wheel rests on the roller, and not on the kerb's upper side, which is in front of it.
        self.assertGreater(height(json.loads(self.watched.get("/loaded?position=0&case=1"))["fields"]["ground_m"], 0.1), -0.34)


class SolidPage(PageTest):
    """The page of a wheel in three dimensions."""

    case = SOLID_CASE

    def surface(self):
        return self.browser.execute_script("return document.getElementById('solid').toDataURL()")

    def at_the_initial_shape(self):
        """Pauses there: from a shape at which the run settled there may be no step."""
        self.paused()
        self.element("reset").click()
        self.until(lambda: self.element("undo").is_enabled())
        return self.watched.frame()["shape"]

    def test_the_surface_follows_each_shape(self):
        self.at_the_initial_shape()
        self.element("roll").click()
        seen = {}
        for _ in range(3):
            shape = self.watched.frame()["shape"]
            self.until(lambda shape=shape: self.element("stage").get_attribute("data-solid") == str(shape))
            seen[shape] = self.surface()
            self.element("step").click()
            self.watched.wait(lambda f, shape=shape: f["shape"] > shape and f["activity"] == "paused")
        self.assertEqual(len(set(seen.values())), 3)
        self.assertFalse(self.element("wheel").is_displayed() or self.element("tools").is_displayed())

    def test_it_is_loaded_rolled_and_turned(self):
        self.paused()
        shape = self.watched.frame()["shape"]
        self.until(lambda: self.element("stage").get_attribute("data-solid") == str(shape))
        self.assertEqual(self.element("load").get_attribute("aria-pressed"), "true")
        first = self.surface()
        self.until(lambda: self.surface() != first)  # it rolls
        self.element("roll").click()
        time.sleep(0.5)
        seen = [self.surface()]
        other = Keys.ARROW_LEFT if self.element("position").get_attribute("value") == "1" else Keys.ARROW_RIGHT
        for control, key in (("load", Keys.ENTER), ("solid", Keys.ARROW_LEFT), ("position", other)):
            self.element(control).send_keys(key)
            self.until(lambda: self.surface() not in seen)
            seen.append(self.surface())
        self.assertEqual(self.element("load").get_attribute("aria-pressed"), "false")

    def test_edges_of_the_initial_holes_are_drawn_over_it(self):
        initial = self.at_the_initial_shape()
        self.element("step").click()
        self.watched.wait(lambda f: f["shape"] > initial and f["activity"] == "paused")
        shape = self.watched.frame()["shape"]
        self.element("roll").click()
        self.until(lambda: self.element("stage").get_attribute("data-solid") == str(shape))
        time.sleep(0.5)
        with_edges = self.surface()
        self.element("ghost").click()
        self.until(lambda: self.surface() != with_edges)
        self.element("ghost").click()
        self.until(lambda: self.surface() == with_edges)

    def test_errors_are_estimated_on_demand(self):
        self.paused()
        shape = self.watched.frame()["shape"]
        self.element("estimate").click()
        self.until(lambda: self.text("errors-text").startswith(f"Errors \u00b1 of shape {shape}"))
        for name in ("objective", "travel", "pressure"):
            self.assertRegex(self.text(f"number-{name}"), r"^[\d.]+ \u00b1 [\d.]+$")

    def test_it_is_steered_and_taken_away(self):
        self.paused()
        travel = self.watched.frame()["numbers"]["mean_travel"]
        self.type("force-number", "6000")
        self.watched.wait(lambda f: f["numbers"]["mean_travel"] > 1.5 * travel)
        self.element("reset").click()
        self.until(lambda: self.element("undo").is_enabled())
        self.until(lambda: "initial shape" in self.text("message"))
        shown = self.watched.frame()["numbers"]["objective_J"]
        self.element("save").click()
        self.until(lambda: self.text("message").startswith("saved"))
        saved = self.folder / self._testMethodName / "designs/design-1.toml"
        support.run_program(program, "run", saved, "--iterations", "0", "--output", self.folder / "from")
        head, first = (line.split(",") for line in (self.folder / "from/history.csv").read_text().splitlines()[:2])
        objective = [k for k, name in enumerate(head) if name.startswith("objective")][0]
        self.assertEqual(float(first[objective]), shown)
        self.element("export").click()
        self.until(lambda: "design-1.stl is downloaded" in self.text("message"))
        self.assertFalse(self.watched.give({"do": "move_hole", "at_m": [0.26, 0], "by_m": [0, 0.01], "scale": 1})["executed"])


class SolidOnGrounds(PageTest):
    """The ground of a wheel in three dimensions is that of the load case, a transparent surface below it."""

    case = SOLID_CASE + """
[[load.case]]
name = "flat"
[[load.case]]
name = "roller"
ground = "drum"
ground_radius = 0.2
"""

    def columns_of_ground(self):
        """How wide the transparent part of the picture is."""
        return self.browser.execute_script("""
            const solid = document.getElementById("solid"), copy = document.createElement("canvas");
            [copy.width, copy.height] = [solid.width, solid.height];
            const context = copy.getContext("2d");
            context.drawImage(solid, 0, 0);
            const data = context.getImageData(0, 0, copy.width, copy.height).data, columns = new Set();
            for (let k = 0; k < copy.width * copy.height; ++k)
              if (data[4 * k + 3] > 60 && data[4 * k + 3] < 200) columns.add(k % copy.width);
            return columns.size;""")

    def test_a_roller_is_narrower_than_a_plane(self):
        self.paused()
        self.still()
        width = {}
        for k, name in enumerate(("flat", "roller", "flat")):
            case = ("flat", "roller").index(name)
            self.element(f"case-{case}").click()
            self.until(lambda case=case: self.loaded("case") == str(case))
            width[name, k] = self.columns_of_ground()
        self.assertEqual(width["flat", 0], width["flat", 2])
        self.assertTrue(0.3 * width["flat", 0] < width["roller", 1] < 0.85 * width["flat", 0], width)


class Design(unittest.TestCase):
    """A wheel is designed using only the page, from a preset to a STEP file."""

    def test_from_a_preset_to_a_step_file(self):
        with tempfile.TemporaryDirectory() as temporary, contextlib.ExitStack() as at_end:
            folder = Path(temporary)
            support.run_program(program, "init", "--preset", design_on_page.PRESET, folder / "case.toml")
            watched = Watched(folder / "case.toml", "--output", folder / "run")
            at_end.callback(watched.end)
            browser = support.open_browser(1440, 900)
            at_end.callback(browser.quit)
            design_on_page.downloads_to(browser, folder)
            browser.get(watched.address)
            page = design_on_page.Page(browser)
            seen = {}
            for name, step in design_on_page.steps(page):
                step()
                seen[name] = {"outline": watched.frame()["outline"], "numbers": watched.frame()["numbers"]}
            objective = lambda name: seen[name]["numbers"]["objective_J_per_m"]
            volume = lambda name: seen[name]["numbers"]["volume_fraction"]
            self.assertGreater(seen["load"]["numbers"]["mean_travel"], seen["begin"]["numbers"]["mean_travel"])
            self.assertGreater(volume("paint"), volume("undo") + 1e-3)
            self.assertEqual(seen["undo"]["numbers"]["volume_fraction"], volume("undo"))
            self.assertNotEqual(seen["even"]["outline"], seen["undo"]["outline"])
            self.assertLess(seen["even"]["numbers"]["run_out"], seen["undo"]["numbers"]["run_out"])
            self.assertEqual(page.number("objective"), float(f"{objective('take_away'):.5g}"))
            step = folder / "my-spokes.step"
            page.until(step.exists)
            self.assertTrue((folder / "run/designs/my-spokes.toml").exists())
            self.assertEqual([e for e in browser.get_log("browser") if e["level"] == "SEVERE"], [])
            watched.end()
            support.run_program(program, "export", folder / "run/designs/my-spokes.toml", "--format", "step", "--output", folder / "written")
            points = lambda file: [line for line in file.read_text().splitlines() if "CARTESIAN_POINT" in line]
            self.assertTrue(points(step) == points(folder / "written/my-spokes.step"))
            self.assertGreater(len(points(step)), 1000)


class OpenedInABrowser:
    """The page that a desktop opens: a stand-in for xdg-open starts the browser with the file that it is given."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "case.toml").write_text(CASE)
        self.profile = self.folder / "profile"
        self.profile.mkdir()
        if not shutil.which(self.command()[0]):
            self.skipTest(f"not installed: {self.command()[0]}")
        stand_in = self.folder / "bin/xdg-open"
        stand_in.parent.mkdir()
        stand_in.write_text(f'#!/bin/sh\nsetsid {" ".join(self.command())} "$1" >/dev/null 2>&1 </dev/null &\n'
                            f"echo $! > {self.folder}/browser\n")
        stand_in.chmod(0o755)

    def end_browser(self):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(int((self.folder / "browser").read_text()), signal.SIGKILL)

    def until(self, wanted, seconds=180):
        end = time.time() + seconds
        while time.time() < end:
            if found := wanted():
                return found
            time.sleep(0.1)
        raise TimeoutError

    def test_the_wheel_is_seen(self):
        desktop = dict(support.one_thread_each(), DISPLAY=":99", PATH=f"{self.folder}/bin:{os.environ['PATH']}")
        process = subprocess.Popen([program, "watch", self.folder / "case.toml", "--output", self.folder / "run",
                                    "--threads", "1"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                   env=desktop)
        try:
            base, token = process.stdout.readline().strip().split("/#")
            self.until((self.folder / "browser").exists)
            evaluate = self.until(self.attach)
            self.until(lambda: evaluate("document.getElementById('wheel')?.dataset.painted ?? ''"))
            self.assertEqual(evaluate("location.href"), base + "/")
            self.until(lambda: float(evaluate("document.getElementById('number-shape').textContent")) > 2)
            self.assertFalse([command for command in command_lines() if token in command])
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=180)
            self.end_browser()


class OpenedInChromium(OpenedInABrowser, unittest.TestCase):
    def command(self):
        return ["chromium", "--headless=new", "--no-sandbox", "--no-first-run", "--remote-debugging-port=0",
                f"--user-data-dir={self.profile}"]

    def attach(self):
        """What evaluates an expression in its tab; None until it has begun."""
        port = self.profile / "DevToolsActivePort"
        if not port.exists() or not port.read_text():
            return None
        browser = support.attach_to_chromium(int(port.read_text().split()[0]))
        self.addCleanup(browser.quit)
        return lambda expression: browser.execute_script(f"return {expression}")


class OpenedInFirefox(OpenedInABrowser, unittest.TestCase):
    def command(self):
        (self.profile / "user.js").write_text('user_pref("marionette.port", 0);')
        return ["firefox-esr", "--headless", "--no-remote", "--marionette", "--profile", str(self.profile)]

    def attach(self):
        port = self.profile / "MarionetteActivePort"
        if not port.exists() or not port.read_text():
            return None
        browser = support.Marionette(int(port.read_text()))
        self.addCleanup(browser.close)
        return lambda expression: browser.ask("WebDriver:ExecuteScript", script=f"return {expression}", args=[])


class Folder(unittest.TestCase):
    """What a watched run leaves, without a browser."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        (self.folder / "case.toml").write_text(CASE)

    def watch(self, *arguments):
        watched = Watched(*arguments)
        self.addCleanup(watched.end)
        return watched

    def results(self, run):
        """All files but locks, without times."""
        found = {}
        for file in sorted((self.folder / run).rglob("*")):
            name = str(file.relative_to(self.folder / run))
            if not file.is_file() or name == "run.lock" or name.startswith("checkpoints/"):
                continue
            content = file.read_text(errors="replace")
            if name == "history.csv":
                rows = [line.split(",") for line in content.splitlines()]
                keep = [k for k, column in enumerate(rows[0]) if not column.endswith("[s]")]
                content = "\n".join(",".join(row[k] for k in keep if k < len(row)) for row in rows)
            if name == "written-by-wheelwright.txt":
                content = "\n".join(sorted(content.splitlines()))  # when the page is first written depends on time
            if name == "report.html":
                content = re.sub(r'"(name|seconds)":("[^"]*"|[-+.0-9e]+)', "", content)
            found[name] = content
        return found

    def replayed(self, run):
        """The results of a run, after a check that its commands give the same bytes without a page."""
        subprocess.run([program, "watch", self.folder / "case.toml", "--output", self.folder / "again", "--replay",
                        self.folder / run / "commands.jsonl", "--threads", "1"], check=False, capture_output=True, timeout=300)
        first, again = self.results(run), self.results("again")
        self.assertEqual(first.keys(), again.keys())
        for name, content in first.items():
            self.assertEqual(content, again[name], name)
        return first

    def test_recorded_commands_give_the_same_bytes_without_a_page(self):
        watched = self.watch(self.folder / "case.toml", "--output", self.folder / "first")
        watched.wait(lambda f: f.get("shape", 0) >= 3)
        load = {k: v for k, v in watched.frame()["settings"]["load"].items() if v is not None}
        hole = [0.27 * 0.92387953, 0.27 * 0.38268343]
        at_rim = [0.205 * 0.92387953, 0.205 * 0.38268343]  # what is painted from there is attached, whatever the shape
        for command in ({"do": "load", **load, "force_N": 4000},
                        {"do": "paint", "as": "material", "path_m": [at_rim, hole], "radius_m": 0.01},
                        {"do": "undo"}, {"do": "step"}, {"do": "volume", "target": 0.88},
                        {"do": "move_hole", "at_m": hole, "by_m": [0.002, 0.001], "scale": 0.9},
                        {"do": "continue"}):
            answer = watched.give(command)
            self.assertTrue(answer["executed"], (command, answer))
            if command["do"] == "step":
                watched.wait(lambda f: f["activity"] == "paused")
        watched.wait(lambda f: f["activity"] == "settled")
        self.assertTrue(watched.give({"do": "reset"})["executed"])
        watched.wait(lambda f: f["activity"] == "settled")
        self.assertEqual(watched.end()[0], 130)
        self.assertEqual(len(self.replayed("first")["commands.jsonl"].splitlines()), 9)

    def test_estimates_of_errors_change_nothing_in_the_run(self):
        watched = self.watch(self.folder / "case.toml", "--output", self.folder / "first")
        shapes = set()
        for force in (3000, 4000, 2500):
            before = watched.wait(lambda f: f.get("shape", 0) > max(shapes, default=0))
            self.assertTrue(json.loads(watched.ask("POST", "/errors"))["executed"])
            load = {k: v for k, v in before["settings"]["load"].items() if v is not None}
            self.assertTrue(watched.give({"do": "load", **load, "force_N": force})["executed"])
            shapes.add(watched.errors()["shape"])
        watched.wait(lambda f: f["activity"] == "settled")
        watched.end()
        self.assertEqual(len(shapes), 3)
        self.assertEqual(len(self.replayed("first")["commands.jsonl"].splitlines()), 4)

    def test_errors_are_those_of_analyze_and_compare(self):
        watched = self.watch(self.folder / "case.toml", "--output", self.folder / "run")
        settled = watched.wait(lambda f: f["activity"] == "settled")
        with contextlib.closing(watched.connect()) as connection:
            for token, status in ((f"Bearer {'0' * 64}", 401), (f"Bearer {watched.token}", 202), (f"Bearer {watched.token}", 409)):
                connection.request("POST", "/errors", headers={"Authorization": token})
                answer = connection.getresponse()
                text = answer.read()
                self.assertEqual(answer.status, status)
        self.assertIn(f"shape {settled['shape']} ", json.loads(text)["text"])  # of which it is already busy
        found = watched.errors()
        self.assertEqual((found["shape"], found["shape_version"]), (settled["shape"], settled["shape_version"]))
        self.assertGreater(found["seconds"], 0)
        self.assertTrue(json.loads(watched.ask("POST", "/save", "design"))["executed"])
        watched.end()
        design = self.folder / "run/designs/design.toml"
        analysis, comparison = (json.loads(support.run_program(program, *command, "--json", "--positions", 4))
                                for command in (("analyze", design), ("compare", design, design)))
        numbers = comparison["wheels"][0]
        self.assertGreater(len(found["errors"]), 10)
        for key, error in found["errors"].items():
            if key != "objective_J_per_m":
                self.assertAlmostEqual(found[key] / numbers[key], 1, 9)
                self.assertAlmostEqual(error, numbers["errors"][key], delta=1e-6 * abs(numbers[key]), msg=key)
        travel, stress = analysis["travel_at_load_m"], analysis["peak_von_mises"]
        for key, value, error in (("mean_travel_m", travel["mean"], travel["errors"]["mean"]),
                                  ("run_out_m", travel["peak_to_peak"], travel["errors"]["peak_to_peak"]),
                                  ("peak_von_mises_Pa", stress["value_Pa"], stress["error_Pa"])):
            self.assertAlmostEqual(found[key] / value, 1, 9)
            self.assertAlmostEqual(found["errors"][key] / error, 1, 6)
        # The objective is the energy, summed over the positions.
        self.assertAlmostEqual(found["errors"]["objective_J_per_m"] / found["errors"]["strain_energy_J_per_m"], 4, 6)

    def test_commands_that_cannot_be_read_leave_no_run(self):
        (self.folder / "broken.jsonl").write_text('{"do": "nothing"}\n')
        for log in ("missing.jsonl", "broken.jsonl"):
            run = subprocess.run([program, "watch", self.folder / "case.toml", "--output", self.folder / "run", "--replay",
                                  self.folder / log], check=False, capture_output=True, text=True, timeout=60)
            self.assertEqual(run.returncode, 2)
            self.assertIn(log, run.stderr)
            self.assertFalse((self.folder / "run").exists())

    def test_a_saved_design_begins_with_the_same_numbers(self):
        watched = self.watch(self.folder / "case.toml", "--output", self.folder / "run")
        watched.wait(lambda f: f.get("shape", 0) >= 4)
        watched.give({"do": "pause"})
        hole = [0.27 * 0.92387953, 0.27 * 0.38268343]
        self.assertTrue(watched.give({"do": "move_hole", "at_m": hole, "by_m": [0.001, 0.002], "scale": 1.1})["executed"])
        shown = watched.frame()["numbers"]["objective_J_per_m"]
        connection = watched.connect()
        for name, status in (("a-design", 200), ("a-design", 422), ("../up", 422), ("", 422), ("x" * 41, 422)):
            connection.request("POST", "/save", name, {"Authorization": f"Bearer {watched.token}"})
            response = connection.getresponse()
            response.read()
            self.assertEqual(response.status, status, name)
        case = self.folder / "run/designs/a-design.toml"
        self.assertEqual({f.name for f in case.parent.iterdir()}, {"a-design.toml", "a-design.levelset", "written-by-wheelwright.txt"})
        watched.end()
        subprocess.run([program, "run", case, "--iterations", "0", "--output", self.folder / "from"], check=True,
                       capture_output=True, timeout=300)
        head, first = (line.split(",") for line in (self.folder / "from/history.csv").read_text().splitlines()[:2])
        self.assertEqual(float(first[[k for k, c in enumerate(head) if c.startswith("objective")][0]]), shown)

    def test_exports_are_what_the_command_writes(self):
        watched = self.watch(self.folder / "case.toml", "--output", self.folder / "run")
        watched.wait(lambda f: f["activity"] == "settled")
        watched.give({"do": "pause"})
        self.assertTrue(watched.give({"do": "reset"})["executed"])  # round holes, which have an outline on any grid
        dxf, report = watched.get("/export?format=dxf"), watched.get("/report")
        self.assertEqual(json.loads(watched.get("/export?format=/etc/passwd"))["executed"], False)
        watched.end()
        subprocess.run([program, "export", self.folder / "run", "--format", "dxf", "--output", self.folder / "files"],
                       check=True, capture_output=True, timeout=300)
        lines = [line for line in dxf.decode().splitlines()]
        written = (self.folder / "files/run.dxf").read_text().splitlines()
        self.assertEqual(len(lines), len(written))
        self.assertLess(sum(a != b for a, b in zip(lines, written)), 3)  # the title
        self.assertIn(b"<!DOCTYPE html>", report)

    def test_a_settled_run_can_be_paused_for_several_changes(self):
        watched = self.watch(self.folder / "case.toml", "--output", self.folder / "run")
        settled = watched.wait(lambda f: f["activity"] == "settled")
        self.assertTrue(watched.give({"do": "pause"})["executed"])
        self.assertEqual(watched.frame()["activity"], "paused")
        load = {k: v for k, v in settled["settings"]["load"].items() if v is not None}
        self.assertTrue(watched.give({"do": "load", **load, "force_N": 4000})["executed"])
        paused = watched.wait(lambda f: f["activity"] == "paused" and f["settings"]["load"]["force_N"] == 4000)
        self.assertEqual(paused["outline"], settled["outline"])
        self.assertTrue(watched.give({"do": "reset"})["executed"])
        paused = watched.wait(lambda f: f["activity"] == "paused" and f["outline"] != settled["outline"])
        self.assertEqual(paused["shape"], settled["shape"])
        self.assertTrue(watched.give({"do": "continue"})["executed"])
        watched.wait(lambda f: f["activity"] == "settled" and f["shape"] > settled["shape"])

    def test_a_killed_run_goes_on(self):
        watched = self.watch(self.folder / "case.toml", "--output", self.folder / "run")
        watched.wait(lambda f: f["activity"] == "settled")
        load = {k: v for k, v in watched.frame()["settings"]["load"].items() if v is not None}
        self.assertTrue(watched.give({"do": "pause"})["executed"])
        self.assertTrue(watched.give({"do": "load", **load, "force_N": 4000})["executed"])
        hole = [0.27 * 0.92387953, 0.27 * 0.38268343]
        self.assertTrue(watched.give({"do": "paint", "as": "hole", "path_m": [hole], "radius_m": 0.032})["executed"])
        before = watched.frame()
        watched.end(signal.SIGKILL)
        again = self.watch(self.folder / "run")
        again.wait(lambda f: f["activity"] in ("computing", "settled"))
        first = again.frame()
        self.assertEqual(first["settings"]["load"]["force_N"], 4000)
        self.assertGreaterEqual(first["shape"], before["shape"])


if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    for _, reason in outcome.skipped:
        print(reason)
    sys.exit(77 if outcome.skipped else not outcome.wasSuccessful())
