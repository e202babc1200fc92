"""The picture and the table of the layers say what src/wheelwright/layers.txt says. From the repository's top folder."""

import re
import subprocess
import unittest
from pathlib import Path

LINES = [line for line in Path("src/wheelwright/layers.txt").read_text().splitlines()
         if line and not line.startswith("#")]
EDGES = {folder.rstrip(":"): used for folder, *used in (line.split() for line in LINES if line[0] != " ")}
PARTS = {folder: [] for folder in EDGES}  # the subfolders
for line in LINES:
    if line[0] == " ":
        PARTS[folder].append(line.split()[0].rstrip(":"))
    else:
        folder = line.split()[0].rstrip(":")
FOLDERS = [name for folder, parts in PARTS.items() for name in (folder, *(f"{folder}/{part}" for part in parts))]


class Layers(unittest.TestCase):
    def test_the_picture_is_what_the_script_draws(self):
        subprocess.run(["scripts/draw-layers", "--check"], check=True)

    def test_the_picture_has_a_dot_for_every_edge(self):
        """In the row of the one folder and the column of the other; names give the places of both."""
        picture = Path("docs/images/layers.svg").read_text()
        names = {name: (float(x), float(y)) for x, y, name in
                 re.findall(r'<text x="([0-9.]+)" y="([0-9.]+)">([\w.]+)<', picture)}
        self.assertEqual(list(names), list(EDGES))
        right, below = (names["base"][d] - 33 for d in (0, 1))  # of a name against its place on the diagonal
        dots = {(float(x), float(y)) for x, y in
                re.findall(r'<circle class="(?:use|circle)" cx="([0-9.]+)" cy="([0-9.]+)"', picture)}
        self.assertEqual(dots, {(names[used][0] - right, names[folder][1] - below)
                                for folder, all_used in EDGES.items() for used in all_used})

    def test_the_table_of_the_folders_is_complete_and_in_order(self):
        section = Path("CONTRIBUTING.md").read_text().split("## Layers")[1].split("\n## ")[0]
        self.assertEqual(re.findall(r"^\| ([\w./]+) \|", section, re.MULTILINE), ["folder", *FOLDERS])

    def test_the_list_names_the_folders_and_headers_of_the_sources(self):
        names = {path.name for path in Path("src/wheelwright").iterdir() if path.is_dir() or path.suffix == ".h"}
        self.assertEqual(names, set(EDGES))
        for folder, parts in PARTS.items():
            if parts:
                names = {path.name for path in Path("src/wheelwright", folder).iterdir() if path.is_dir()}
                self.assertEqual(names, set(parts))


if __name__ == "__main__":
    unittest.main()
