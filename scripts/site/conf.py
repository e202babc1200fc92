"""How Sphinx makes the site of the documents, for scripts/build-docs. The pages are the Markdown files of the repository,
as they are; the groups of the navigation are the paragraphs under "Documentation" in the README."""

import os
import re
import shutil
import sys
from pathlib import Path

from docutils import nodes
from sphinx.util.nodes import make_refnode

sys.path.insert(0, str(Path(__file__).parent))
import formulas  # noqa: E402
import offline_theme  # noqa: E402

top = Path(__file__).resolve().parents[2]

project = "Wheelwright"
author = "The developers of Wheelwright"
release = (top / "VERSION").read_text(encoding="utf-8").split()[0]

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
root_doc = "README"
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/*.md", "examples/*/README.md"]
exclude_patterns = [".*", "build*", "runs", "src"]
source_suffix = {".md": "markdown"}
myst_enable_extensions = ["dollarmath", "html_image"]
myst_heading_anchors = 4
nitpicky = True
highlight_language = "none"
smartquotes = False

# The reference of the Python module is read from its sources, without the extension, which need not be built.
sys.path.insert(0, str(top / "python"))
os.environ.setdefault("OPENBLAS_CORETYPE", "Haswell")
autodoc_mock_imports = ["wheelwright._core", "wheelwright._environment"]
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
napoleon_numpy_docstring = False
nitpick_ignore_regex = [("py:.*", r"(?!wheelwright).*"), ("py:.*", r"wheelwright\._core\..*"), ("py:.*", r"wheelwright\..*\.(Client|Event|Designs|Value|Array|FloatArray|IntArray)")]

html_theme = "furo"
html_title = f"Wheelwright {release}"
html_math_renderer = "katex"
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
html_show_search_summary = False  # it would read the pages, which browsers forbid for files
html_static_path = ["static"]
html_css_files = ["katex/katex.min.css", "site.css"]
html_js_files = ["site.js"]
templates_path = ["templates"]
html_sidebars = {"**": ["sidebar/brand.html", "sidebar/search.html", "sidebar/scroll-start.html", "sidebar/navigation.html",
                        "sidebar/reference.html", "sidebar/scroll-end.html"]}


def toctree(caption, pages):
    return "\n".join(["", "```{toctree}", ":hidden:", f":caption: {caption}", "", *pages, "```", ""])


def navigation(readme):
    """Toctrees of the pages that the README lists under "Documentation", by its paragraphs, e.g. "For users: ..."."""
    section = re.search(r"^## Documentation\n(.*?)^## ", readme, re.MULTILINE | re.DOTALL)[1]
    listed, trees = set(), ""
    for caption, links in re.findall(r"^(For \w+): (.*?)\n\n", section, re.MULTILINE | re.DOTALL):
        pages = [page for page in dict.fromkeys(re.findall(r"\]\(([\w/-]+)\.md", links)) if page not in listed]
        listed.update(pages)
        trees += toctree(caption, pages)
    examples = sorted(str(page.relative_to(top).with_suffix("")) for page in top.glob("examples/*/README.md"))
    return trees + toctree("Examples", examples)


def code_of(folder):
    """The files of an example, for its page."""
    languages = {".cc": "cpp", ".h": "cpp", ".txt": "cmake", ".toml": "toml"}
    shown = [file for file in sorted(folder.iterdir()) if file.suffix in languages]
    return "".join(f"\n## {file.name}\n\n```{{literalinclude}} {file.name}\n:language: {languages[file.suffix]}\n```\n"
                   for file in shown)


def complete_source(app, page, source):
    """What the site adds to a page."""
    if page == root_doc:
        source[0] += navigation(source[0])
    if page.startswith("examples/"):
        source[0] += code_of((top / page).parent)
    source[0] = source[0].replace("```math\n", "```{math}\n")


def link_to_folder(app, env, reference, text):
    """Links to the folder of an example lead to its page."""
    folder = (top / reference["refdoc"]).parent / reference["reftarget"]
    page = folder / "README"
    if not folder.is_dir() or not page.with_suffix(".md").is_file():
        return None
    return make_refnode(app.builder, reference["refdoc"], str(page.resolve().relative_to(top)), None, text)


def chain_of(diagram):
    """Texts of the boxes of a Mermaid flowchart that is one chain."""
    chain, last = {}, None
    for line in diagram.splitlines():
        if "-->" not in line:
            continue
        boxes = [re.fullmatch(r"(\w+)(?:\[\"?(.*?)\"?\])?", box.strip()) for box in line.split("-->")]
        if last not in (None, boxes[0][1]):
            raise ValueError(f"The site can only draw a chain of boxes, but {boxes[0][1]} does not continue it.")
        last = boxes[-1][1]
        for box in boxes:
            chain[box[1]] = box[2] or chain.get(box[1], box[1])
    return list(chain.values())


def draw_chains(app, document):
    """Mermaid's flowcharts as boxes with arrows."""
    for block in list(document.findall(nodes.literal_block)):
        if block.get("language") == "mermaid":
            boxes = "".join(f"<li>{text}</li>" for text in chain_of(block.astext()))
            block.replace_self(nodes.raw("", f'<ol class="chain">{boxes}</ol>', format="html"))


def open_pictures(app, page, template, context, document):
    """Every picture is a link to itself, which site.js opens over the page."""
    if "body" in context:
        context["body"] = re.sub(r'<img [^>]*?src="([^"]+)"[^>]*>', r'<a class="picture" href="\1">\g<0></a>', context["body"])


def begin_at_readme(app, error):
    """The folder opens at its first page."""
    if not error and app.builder.name == "html":
        shutil.copy(Path(app.outdir) / f"{root_doc}.html", Path(app.outdir) / "index.html")


def setup(app):
    formulas.setup(app)
    offline_theme.setup(app)
    app.connect("source-read", complete_source)
    app.connect("missing-reference", link_to_folder)
    app.connect("doctree-read", draw_chains)
    app.connect("html-page-context", open_pictures)
    app.connect("build-finished", begin_at_readme)
