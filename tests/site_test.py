"""Tests of the site that scripts/build-docs makes, in a browser and without a network. usage: site_test.py, from the
repository's top folder."""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import support

missing = [package for package, file in (("python3-sphinx", "/usr/bin/sphinx-build"),
                                         ("python3-myst-parser", "/usr/lib/python3/dist-packages/myst_parser"),
                                         ("furo", "/usr/lib/python3/dist-packages/furo"),
                                         ("katex", "/usr/share/nodejs/katex"),
                                         ("doxygen", "/usr/bin/doxygen")) if not Path(file).exists()]
if missing:
    print("not installed:", *missing)
    sys.exit(77)
support.skip_without_browser()

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.wait import WebDriverWait


def build(top, folder):
    return subprocess.run([top / "scripts/build-docs", folder], capture_output=True, text=True, check=False, timeout=600)


class Site(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        built = build(Path.cwd(), cls.folder.name)
        assert built.returncode == 0, built.stdout + built.stderr
        cls.site = Path(cls.folder.name) / "html"
        cls.browser = support.open_browser(1300, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.folder.cleanup()

    def tearDown(self):
        requests = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        addresses = [request["params"]["request"]["url"] for request in requests
                     if request["method"] == "Network.requestWillBeSent"]
        self.assertEqual([address for address in addresses if not address.startswith(("file:", "data:"))], [])
        self.assertEqual([entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"], [])

    def open(self, page):
        self.browser.get((self.site / page).as_uri())

    def wait_for(self, css):
        return WebDriverWait(self.browser, 20).until(lambda browser: browser.find_elements(By.CSS_SELECTOR, css))

    def test_every_page_can_be_reached_from_the_first_one(self):
        self.open("index.html")
        linked = {link.get_attribute("href") for link in self.browser.find_elements(By.CSS_SELECTOR, ".sidebar-tree a")}
        pages = [Path("CHANGELOG"), Path("CONTRIBUTING"), *(page.with_suffix("") for page in Path("docs").glob("*.md")),
                 *(page.with_suffix("") for page in Path("examples").glob("*/README.md"))]
        self.assertEqual([page for page in pages if (self.site / f"{page}.html").as_uri() not in linked], [])
        self.assertIn((self.site / "cpp/index.html").as_uri(), linked)
        self.assertTrue((self.site / "cpp/index.html").exists())

    def test_a_search_finds_text_of_documents_and_examples(self):
        for words, page in (("macro-elements nothing", None), ("ghost penalty", "docs/method.html"),
                            ("checkpoint", "docs/architecture.html"), ("WarmPolymer", "examples/own_material/README.html")):
            self.open("index.html")
            box = self.browser.find_element(By.CSS_SELECTOR, ".sidebar-search")
            box.send_keys(words, Keys.ENTER)
            WebDriverWait(self.browser, 20).until(
                lambda browser: re.search("found|did not match", browser.find_element(By.ID, "search-results").text))
            found = [link.get_attribute("href").split("?")[0].split("#")[0]
                     for link in self.browser.find_elements(By.CSS_SELECTOR, "#search-results li a")]
            if page is None:
                self.assertEqual(found, [])
            else:
                self.assertIn((self.site / page).as_uri(), found)

    def test_formulas_are_set_with_their_fonts(self):
        self.open("docs/method.html")
        self.assertGreater(len(self.wait_for("article .katex")), 200)
        fonts = """const done = arguments[0];
            document.fonts.ready.then(() => done([...document.fonts].map((font) => [font.family, font.status])));"""
        states = {family.strip('"'): status for family, status in self.browser.execute_async_script(fonts)
                  if status != "unloaded"}
        self.assertEqual((states.get("KaTeX_Main"), states.get("KaTeX_Math")), ("loaded", "loaded"))
        self.assertNotIn("error", states.values())

    def test_a_picture_opens_over_the_page_and_closes(self):
        self.open("README.html")
        link = self.wait_for("article a.picture")[0]
        small = link.find_element(By.TAG_NAME, "img").size["width"]
        link.send_keys(Keys.ENTER)
        large = self.wait_for("dialog[open] img")[0]
        self.assertGreater(large.size["width"], 1.5 * small)
        self.assertTrue(self.browser.execute_script("return arguments[0].decode().then(() => true)", large))
        self.browser.switch_to.active_element.send_keys(Keys.ENTER)
        WebDriverWait(self.browser, 20).until(lambda browser: not browser.find_elements(By.TAG_NAME, "dialog"))
        self.assertTrue(self.browser.current_url.endswith("README.html"))

    def test_the_chain_of_values_is_a_row_of_boxes(self):
        self.open("docs/architecture.html")
        boxes = [box.text for box in self.wait_for("ol.chain li")]
        self.assertEqual((boxes[0], boxes[-1]), ("LevelSet", "next LevelSet"))


class Mistakes(unittest.TestCase):

    def test_wrong_links_and_formulas_are_errors(self):
        with tempfile.TemporaryDirectory() as folder:
            top = Path(folder) / "source"
            for name in ("docs", "examples", "scripts", "src"):
                shutil.copytree(name, top / name)
            for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE", "VERSION"):
                shutil.copy(name, top)
            with (top / "docs/glossary.md").open("a", encoding="utf-8") as page:
                page.write("\n[no heading](method.md#no-such-heading), [no page](nothing.md), $\\nosuchmacro$\n")
            (top / "docs/unlisted.md").write_text("# A page that the README does not list\n", encoding="utf-8")
            built = build(top, Path(folder) / "site")
        self.assertNotEqual(built.returncode, 0)
        for mistake in ("no-such-heading", "nothing.md", "nosuchmacro", "unlisted.md"):
            self.assertIn(mistake, built.stderr)


if __name__ == "__main__":
    unittest.main()
