"""Formulas as HTML that needs neither a network nor a script: KaTeX makes it when the site is built, from the packages
katex and fonts-katex of Debian. A formula that KaTeX does not understand is a warning."""

import json
import shutil
import subprocess
from pathlib import Path

from docutils import nodes
from sphinx.util import logging

LOGGER = logging.getLogger(__name__)
KATEX = Path("/usr/share/javascript/katex")

# Reads formulas and writes their HTML, each on a line, as JSON.
PROGRAM = """
const katex = require("/usr/share/nodejs/katex");
const render = ({ text, displayMode }) => {
  try { return { html: katex.renderToString(text, { displayMode, strict: "error" }) }; }
  catch (error) { return { error: error.message }; }
};
require("readline").createInterface({ input: process.stdin })
  .on("line", (line) => console.log(JSON.stringify(render(JSON.parse(line)))));
"""


class Renderer:

    def __init__(self):
        self.node = None

    def html(self, text, is_block, where):
        if self.node is None:
            self.node = subprocess.Popen(["node", "--eval", PROGRAM], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                         encoding="utf-8")
        self.node.stdin.write(json.dumps({"text": text, "displayMode": is_block}) + "\n")
        self.node.stdin.flush()
        answer = json.loads(self.node.stdout.readline())
        if "error" in answer:
            LOGGER.warning("formula %s: %s", text, answer["error"], location=where)
        return answer.get("html", "")

    def close(self, *_):
        if self.node is not None:
            self.node.communicate()
            self.node = None

    def inline(self, translator, formula):
        translator.body.append(self.html(formula.astext(), False, formula))
        raise nodes.SkipNode

    def block(self, translator, formula):
        translator.body.append(f'<div class="formula">{self.html(formula.astext(), True, formula)}</div>')
        raise nodes.SkipNode


def copy_style(app, error):
    """KaTeX's style and fonts, as the page names them."""
    if error or app.builder.format != "html":
        return
    static = Path(app.outdir) / "_static" / "katex"
    (static / "fonts").mkdir(parents=True, exist_ok=True)
    shutil.copy(KATEX / "katex.min.css", static)
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copy(font, static / "fonts")


def setup(app):
    renderer = Renderer()
    app.add_html_math_renderer("katex", (renderer.inline, None), (renderer.block, None))
    app.connect("build-finished", renderer.close)
    app.connect("build-finished", copy_style)
