"""Designs a wheel using only the page of `wheelwright watch`, from a preset to a STEP file, by mouse and keyboard: the steps of
docs/watch.md. The test of the page looks at what each of them changes, and scripts/draw-watch draws them."""

import json
import math
import time

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

PRESET = "curved-spokes"


def offset(page, point):
    """Where a point of the wheel (body frame, metres) is seen, from the middle of the canvas, in pixels."""
    view, size = json.loads(page.wheel("view")), page.element("wheel").size
    c, s = math.cos(view["turn"]), math.sin(view["turn"])
    x, y = c * point[0] - s * point[1], s * point[0] + c * point[1]
    return (round(view["x"] + view["scale"] * x - size["width"] / 2),
            round(view["y"] - view["scale"] * y - size["height"] / 2))


class Page:
    """What a user sees of the page and does on it. `look` is called now and then while the user waits."""

    def __init__(self, browser, look=lambda: None):
        self.browser = browser
        self.look = look

    def element(self, name):
        return self.browser.find_element(By.ID, name)

    def text(self, name):
        return self.element(name).text

    def wheel(self, name):
        return self.element("wheel").get_attribute(f"data-{name}")

    def shape(self):
        return int(self.wheel("shape") or -1)

    def number(self, name):
        return float(self.text(f"number-{name}").split()[0])

    def until(self, wanted, seconds=180):
        end = time.time() + seconds
        while not wanted():
            if time.time() > end:
                raise TimeoutError(self.text("state") + " " + self.text("message"))
            self.look()
            time.sleep(0.02)

    def more_shapes(self, n):
        """Waits for so many, or until there are no better ones."""
        first = self.shape()
        self.until(lambda: self.shape() >= first + n or "no better shape" in self.text("state"))

    def type(self, name, text):
        self.element(name).send_keys(Keys.CONTROL, "a", Keys.NULL, text, Keys.ENTER)

    def press_go(self, until_it_offers):
        """Clicks the button that pauses and continues. A step that ends just before the click gives it the other meaning:
        then it is clicked again."""
        clicked = -math.inf

        def offers():
            nonlocal clicked
            if self.text("go") == until_it_offers:
                return True
            if time.time() > clicked + 5:
                self.element("go").click()
                clicked = time.time()
            return False

        self.until(offers)

    def pause(self):
        """Also where the run waits because there is no better shape: it then waits through the next changes too."""
        self.press_go(until_it_offers="Continue")

    def go_on(self):
        """From a pause, or from the end of a step. The page shows afterwards that the run went on."""
        self.pause()
        self.press_go(until_it_offers="Pause")

    def stroke(self, tool, radii, azimuth, steps=6):
        """Draws with the mouse along a ray, at these shares of the outer radius."""
        self.element(f"tool-{tool}").click()
        wheel = self.element("wheel")
        ActionChains(self.browser).move_to_element(wheel).perform()  # it stands still under the mouse
        outer = self.browser.execute_script("return arguments[0].dataset.ground - JSON.parse(arguments[0].dataset.view).y", wheel)
        outer /= json.loads(self.wheel("view"))["scale"]
        at = lambda r: offset(self, (outer * r * azimuth[0], outer * r * azimuth[1]))
        places = [at(radii[0] + (radii[1] - radii[0]) * k / steps) for k in range(steps + 1)]
        actions = ActionChains(self.browser, duration=30)
        actions.move_to_element_with_offset(wheel, *places[0]).click_and_hold()
        for (x, y), (nx, ny) in zip(places, places[1:]):
            actions.move_by_offset(nx - x, ny - y)
        actions.release().perform()

    def obeyed(self, beginning):
        self.until(lambda: self.text("message").startswith(beginning))


def steps(page):
    """Each step: its name, and what the user does."""

    def begin():
        page.until(lambda: page.shape() >= 3)
        page.pause()
        page.element("reset").click()  # it changed before the page was there
        page.obeyed("back to the initial shape")
        for _ in range(10):
            page.look()
            before = page.shape()
            page.element("step").click()
            page.until(lambda before=before: page.shape() > before or "no better shape" in page.text("state"))
        page.go_on()

    def load():
        page.type("force-number", "4000")
        page.obeyed("new load: force 4000 N")
        page.more_shapes(6)

    def paint():
        page.pause()
        page.stroke("paint", (0.6, 0.97), (0.995, 0.1))
        page.obeyed("material added along a line")

    def undo():
        page.element("undo").click()
        page.obeyed("undid: material added along a line")

    def even():
        page.type("even-number", "5")
        page.obeyed("new weights")
        page.go_on()
        page.more_shapes(8)
        page.pause()

    def contact():
        page.element("tool-look").click()
        for _ in range(4):
            page.element("zoom-in").click()
            page.look()
        for _ in range(12):
            page.look()
            time.sleep(0.1)

    def take_away():
        page.element("fit").click()
        page.type("name", "my-spokes")
        page.element("save").click()
        page.obeyed("saved")
        page.element("format").send_keys("STEP")
        page.element("export").click()
        page.obeyed("my-spokes.step is downloaded")

    return [("begin", begin), ("load", load), ("paint", paint), ("undo", undo), ("even", even), ("contact", contact),
            ("take_away", take_away)]


def downloads_to(browser, folder):
    browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})
