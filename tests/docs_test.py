"""Tests that the documents are consistent: tables are complete, and links, paths and names of tests exist. usage:
docs_test.py, from the repository's top folder."""

import re
import unittest
from pathlib import Path

PAGES = sorted([Path("README.md"), Path("CONTRIBUTING.md"), Path("CHANGELOG.md"), *Path("docs").glob("*.md"),
                *Path("examples").glob("*/README.md")])
CODE_BLOCK = re.compile(r"^ *```.*?^ *```$|^(?:    [^\n]*\n)+", re.MULTILINE | re.DOTALL)

SOURCE_ENDINGS = (".cc", ".h", ".in", ".cmake", ".py", ".sh", ".js", ".html", ".css", ".toml", ".txt", ".json", ".bash")
NAMES_OF_OTHERS = {"MyLaw", "benchmark_filter"}


def text_of(page):
    return page.read_text(encoding="utf-8")


def prose(page):
    """Without blocks of code; with as many lines."""
    return CODE_BLOCK.sub(lambda block: re.sub(r"[^\n]", "", block[0]), text_of(page))


def anchors(page):
    """Those that GitHub gives headings."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", prose(page), re.MULTILINE):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        anchor = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        number = 1
        while anchor + (f"-{number}" if number > 1 else "") in found:
            number += 1
        found.add(anchor + (f"-{number}" if number > 1 else ""))
    return found


def cells(line):
    """Of a line of a table: neither bars in code nor escaped ones separate."""
    plain = re.sub(r"`[^`]*`|\\\||\$[^$]*\$", "", line.strip())
    return plain.strip("|").count("|") + 1


def numbers(text):
    """Those that a text states, each with whether it is a percentage."""
    return {(float(number), bool(percent)) for number, percent in re.findall(r"(?<![\w.])(\d+(?:\.\d+)?(?:e-?\d+)?)( %)?(?!\w)", text)}


class Docs(unittest.TestCase):

    def test_every_line_of_a_table_has_as_many_cells_as_its_head(self):
        n_tables, wrong = 0, []
        for page in PAGES:
            head = None
            for number, line in enumerate(prose(page).splitlines(), 1):
                if not line.lstrip().startswith("|"):
                    head = None
                    continue
                if head is None:
                    head = cells(line)
                    n_tables += 1
                if cells(line) != head:
                    wrong.append(f"{page}:{number}: {line[:100]}")
        self.assertEqual(wrong, [])
        self.assertGreater(n_tables, 20)

    def test_links_lead_to_files_and_headings_that_exist(self):
        n_links, wrong = 0, []
        for page in PAGES:
            for target in re.findall(r"\]\(([^)\s]+)\)|<img src=\"([^\"]+)\"", prose(page)):
                path, _, anchor = (target[0] or target[1]).partition("#")
                if re.match(r"\w+:", path):
                    continue
                n_links += 1
                file = (page.parent / path).resolve() if path else page.resolve()
                if not file.exists() or (anchor and anchor not in anchors(file)):
                    wrong.append(f"{page}: {path}#{anchor}")
        self.assertEqual(wrong, [])
        self.assertGreater(n_links, 100)

    def test_source_files_and_scripts_that_are_named_exist(self):
        n_names, wrong = 0, []
        for page in PAGES:
            if page.name == "CHANGELOG.md":  # which also tells of what was removed
                continue
            for name in re.findall(r"`((?:[\w.-]+/)+[\w.-]+\.(?:cc|h|py|sh|txt|cmake|toml|js)|scripts/[\w-]+)`", text_of(page)):
                if "NAME" in name or name.startswith(("build/", "runs/", "designs/", "failure/")):  # of the user
                    continue
                n_names += 1
                if not any((top / name).exists() for top in (Path("."), Path("src"), Path("src/wheelwright"), Path("tests"))):
                    wrong.append(f"{page}: {name}")
        self.assertEqual(wrong, [])
        self.assertGreater(n_names, 100)

    def test_identifiers_that_are_named_exist(self):
        sources = [file for top in ("src", "tests", "scripts", "bench", "cmake", "packaging", "examples", "cases", "python")
                   for file in Path(top).rglob("*") if file.suffix in SOURCE_ENDINGS or (top == "scripts" and file.is_file())]
        text = " ".join(file.read_text(encoding="utf-8", errors="replace")
                        for file in [*sources, Path("CMakeLists.txt"), Path("CMakePresets.json"), Path("tests/CMakeLists.txt")])
        known = {*re.findall(r"\w+", text), *(file.stem for file in sources)}
        n_names, wrong = 0, []
        for page in PAGES:
            if page.name == "CHANGELOG.md":
                continue
            for code in re.findall(r"`([^`\n]+)`", prose(page)):
                without_files = re.sub(r"[\w./-]+\.(?:cc|h|py|sh|txt|json|csv|svg|toml|html|vtu|jsonl)\b", "", code)
                for name in re.findall(r"\b[A-Za-z]\w*(?:_[a-z]|[a-z][A-Z])\w*", without_files):
                    n_names += 1
                    if name not in known and name not in NAMES_OF_OTHERS:
                        wrong.append(f"{page}: {name}")
        self.assertEqual(wrong, [])
        self.assertGreater(n_names, 400)

    def test_the_claims_have_the_numbers_of_the_tables_and_commands_that_exist(self):
        claims, _, tables = text_of(Path("docs/verification.md")).partition("\n## ")
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in claims.splitlines() if line.startswith("| ")]
        known = numbers(tables + text_of(Path("docs/performance.md")))
        tests = {f"{suite}.{name}" for file in Path("tests").glob("*_test.cc")
                 for suite, name in re.findall(r"^TEST(?:_F|_P)?\((\w+), (\w+)\)", text_of(file), re.MULTILINE)}
        self.assertTrue(12 <= len(rows) - 1 <= 16, len(rows))
        for claim, _, measured, command in rows[1:]:
            self.assertEqual(numbers(measured) - known, set(), claim)
            first, *arguments = command.strip("`").split()
            if "-R" in arguments:
                self.assertTrue(any(arguments[arguments.index("-R") + 1] in name for name in tests), command)
            else:
                self.assertTrue(all(Path(word).exists() for word in [first, *arguments] if "/" in word), command)

    def test_generated_parts_have_a_begin_and_an_end(self):
        for page in PAGES:
            marks = re.findall(r"^<!-- ([\w-]+): (begin|end) -->$", text_of(page), re.MULTILINE)
            self.assertEqual(marks[::2], [(name, "begin") for name, _ in marks[::2]], page)
            self.assertEqual(marks[1::2], [(name, "end") for name, _ in marks[::2]], page)


if __name__ == "__main__":
    unittest.main()
