"""Tests what programs that drive the program rely on: exit codes, JSON and events against their schemas in docs/schema.
usage: driving_test.py PROGRAM, from the repository's top folder."""

import csv
import importlib.util
import json
import math
import re
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import support

if not importlib.util.find_spec("jsonschema"):
    print("not installed: python3-jsonschema")
    sys.exit(77)

import jsonschema

program = sys.argv.pop(1)
SCHEMAS = {file.name.split(".")[0]: json.loads(file.read_text(encoding="utf-8")) for file in Path("docs/schema").glob("*.json")}

CASE = """
[wheel]
sectors = 8
[load]
positions = 2
[[holes.ring]]
count = 8
center_radius = 0.266
radius = 0.03
[grid]
radial_cells = 8
angular_cells = 96
tread_levels = 0
[optimizer]
rim_band = 0.0175
tread_band = 0.035
iterations = 3
"""
# No wheel of this material is so stiff.
# In 3D, small; the moulds part away from the middle.
MOULDED_CASE = """
[wheel]
dimension = 3
sectors = 8
width = 0.12
[load]
positions = 1
[material]
poissons_ratio = 0.3
[[holes.ring]]
count = 8
center_radius = 0.265
radius = 0.03
[grid]
radial_cells = 8
angular_cells = 64
axial_cells = 4
degree = 1
tread_levels = 0
[optimizer]
iterations = 2
rim_band = 0.018
tread_band = 0.036
made = "moulded"
draft = 3
parting_plane = 0.03
"""

# Its holes narrow upwards by more than allowed.
PRINTED_CASE = MOULDED_CASE.split("made =")[0].replace("holes.ring", "holes.tapered").replace(
    "radius = 0.03\n", "profile = [[-0.06, 0.038], [0, 0.02], [0.06, 0.005]]\n").replace("angular_cells = 64", "angular_cells = 96") + """
made = "printed"
overhang = 10
stands_on = "smaller_z"
[output]
errors = "none"
"""

BOUNDED_CASE = CASE.replace("iterations = 3", 'iterations = 2\nmethod = "sequential_quadratic"') + """
[[constraint]]
quantity = "stiffness"
at_least = "600000 N/mm"
[[expect]]
quantity = "objective"
value = 1.0
margin = 0.01
"""


def run(*arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False, timeout=300,
                          env=support.one_thread_each())


def validator(name):
    jsonschema.Draft202012Validator.check_schema(SCHEMAS[name])
    return jsonschema.Draft202012Validator(SCHEMAS[name])


def events_of(output):
    return [json.loads(line) for line in output.splitlines()]


class Driving(unittest.TestCase):

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return self.folder / name

    def assert_events(self, events, exit_code):
        """They are those of the schema, which knows all of their keys, from the begin to the end."""
        for event in events:
            validator("event").validate(event)
            known = SCHEMAS["event"]["$defs"][event["event"]]["properties"]
            self.assertEqual(set(event) - set(known), set(), event)
        self.assertEqual([event["event"] for event in events].count("end"), 1)
        self.assertEqual((events[-1]["event"], events[-1]["exit_code"]), ("end", exit_code))

    def test_exit_codes_are_those_of_the_page(self):
        pattern = r"^ *\|? *(\d+) *(?:\|)? *(.*?)(?: \|)?$"
        printed = run("--help").stdout.split("Exit codes:")[1].strip("\n")
        page = Path("docs/driving.md").read_text(encoding="utf-8").split("|---|---|\n")[1].split("\n\n")[0]
        self.assertEqual(re.findall(pattern, page, re.MULTILINE), re.findall(pattern, printed, re.MULTILINE))
        codes = {int(code) for code, _ in re.findall(pattern, printed, re.MULTILINE)}
        self.assertEqual(set(SCHEMAS["event"]["$defs"]["end"]["properties"]["exit_code"]["enum"]), codes)

    def test_a_run_tells_its_shapes_and_its_end(self):
        case, results = self.write("case.toml", CASE), self.folder / "results"
        done = run("run", case, "--output", results, "--events", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        events = events_of(done.stdout)
        self.assert_events(events, 0)
        self.assertEqual(events[0]["event"], "begin")
        self.assertEqual(events[-1]["reason"], "iterations")
        told = [event["text"] for event in events if event["event"] == "warning" and event["subject"] == "case"]
        self.assertEqual([f"warning: {case}: {text}" for text in told], done.stderr.splitlines())
        self.assertGreater(len(told), 0)

        shapes = [event for event in events if event["event"] == "shape"]
        rows = [line.split(",") for line in (results / "history.csv").read_text(encoding="utf-8").splitlines()]
        names = [name.split(" ")[0] for name in rows[0]]
        accepted = [dict(zip(names, row)) for row in rows[1:] if dict(zip(names, row))["accepted"] == "1"]
        self.assertEqual([shape["iteration"] for shape in shapes], [0, 1, 2, 3])
        self.assertEqual([shape["objective"] for shape in shapes], [float(row["objective"]) for row in accepted])
        rejected = [event for event in events if event["event"] == "rejected"]
        self.assertEqual(len(shapes) + len(rejected), len(rows) - 1)
        self.assertIn({"event": "checkpoint", "iteration": 3}, events)

        summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
        validator("summary").validate(summary)
        self.assertAlmostEqual(summary["after"]["objective_J_per_m"], shapes[-1]["objective"], delta=0.01)

        again = run("resume", results, "--events", "json", "--iterations", 5)
        resumed = events_of(again.stdout)
        self.assert_events(resumed, 0)
        self.assertEqual(resumed[0]["resumed_after"], 3)
        finished = run("resume", results, "--events", "json", "--iterations", 5)
        self.assert_events(events_of(finished.stdout), 0)
        self.assertEqual(events_of(finished.stdout)[-1]["reason"], None)

    def test_a_run_tells_how_its_wheel_is_made(self):
        results = self.folder / "results"
        done = run("run", self.write("case.toml", MOULDED_CASE), "--output", results)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
        validator("summary").validate(summary)
        made, draft = summary["made"], summary["made"]["smallest_draft"]
        self.assertEqual(made["how"], "moulded")
        self.assertAlmostEqual(made["parting_plane_m"], 0.03)
        self.assertAlmostEqual(made["draft_rad"], math.radians(3))
        self.assertGreater(draft["angle_rad"], 0)
        self.assertTrue(0.20 < draft["radius_m"] < 0.34 and 0 <= draft["z_m"] <= 0.12, draft)
        # The terminal, the page and export say it too.
        angle = f"{math.degrees(draft['angle_rad']):.3g} deg"
        self.assertIn(angle, done.stdout)
        self.assertIn(angle, (results / "report.html").read_text(encoding="utf-8"))
        exported = run("export", results, "--output", self.folder).stdout
        told = re.search(r"z = ([\d.]+) mm, smallest draft ([\d.]+) deg", exported)
        self.assertEqual(told[1], "30.0")
        self.assertAlmostEqual(float(told[2]), math.degrees(draft["angle_rad"]), delta=0.5)  # another surface

    def test_a_run_tells_how_its_wheel_is_printed(self):
        results = self.folder / "results"
        case = self.write("case.toml", PRINTED_CASE)
        self.assertRegex(run("check", case).stdout, r"printed .*z = 0\.0 mm, largest overhang [-\d.]+ deg")
        done = run("run", case, "--output", results)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("cannot be printed without support", done.stdout + done.stderr)
        summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
        validator("summary").validate(summary)
        made, overhang = summary["made"], summary["made"]["largest_overhang"]
        self.assertEqual(made["how"], "printed")
        self.assertEqual(made["plate_m"], 0)
        self.assertAlmostEqual(made["overhang_rad"], math.radians(10))
        self.assertLess(overhang["angle_rad"], math.radians(10 + 3))
        self.assertTrue(0.20 < overhang["radius_m"] < 0.34 and 0 <= overhang["z_m"] <= 0.12, overhang)
        # The terminal, the page and export say it too.
        angle = f"{math.degrees(overhang['angle_rad']):.3g} deg"
        self.assertIn(angle, done.stdout)
        self.assertIn(angle, (results / "report.html").read_text(encoding="utf-8"))
        exported = run("export", results, "--output", self.folder).stdout
        told = re.search(r"z = ([\d.]+) mm, largest overhang ([-\d.]+) deg", exported)
        self.assertEqual(told[1], "0.0")
        self.assertAlmostEqual(float(told[2]), math.degrees(overhang["angle_rad"]), delta=1)  # another surface

    def test_check_tells_how_a_wheel_is_made(self):
        case = self.write("case.toml", MOULDED_CASE)
        self.assertRegex(run("check", case).stdout, r"moulded .*z = 30\.0 mm, smallest draft [\d.]+ deg")
        case.write_text(MOULDED_CASE.replace("moulded", "extruded").split("draft")[0], encoding="utf-8")
        self.assertRegex(run("check", case).stdout, r"\n +extruded +\w")

    def test_a_bound_that_is_violated_is_told(self):
        done = run("run", self.write("case.toml", BOUNDED_CASE), "--output", self.folder / "results", "--events", "json")
        events = events_of(done.stdout)
        self.assertEqual(done.returncode, 9)
        self.assert_events(events, 9)
        bounds = [event["bounds"] for event in events if event["event"] == "shape"][-1]
        self.assertEqual([(bound["name"], bound["relation"], bound["is_kept"]) for bound in bounds], [("stiffness", ">", False)])
        for bound in bounds:
            self.assertEqual(set(bound), set(SCHEMAS["event"]["$defs"]["bound"]["properties"]))

    def test_a_run_that_does_not_begin_ends(self):
        case, results = self.write("case.toml", CASE), self.folder / "results"
        self.assertEqual(run("run", case, "--output", results, "--iterations", 1).returncode, 0)
        wrong = self.write("wrong.toml", CASE.replace("sectors = 8", "sectors = 0"))
        for arguments, code in ((("run", case, "--output", results), 4), (("run", wrong), 2),
                                (("resume", self.folder / "nothing"), 2)):
            done = run(*arguments, "--events", "json")
            self.assertEqual(done.returncode, code)
            events = events_of(done.stdout)
            self.assert_events(events, code)
            self.assertEqual((len(events), events[0]["reason"]), (1, None))
            self.assertNotEqual(done.stderr, "")
        self.assertEqual(run("run", case, "--events", "xml").returncode, 2)

    def test_a_stopped_run_says_so(self):
        case = self.write("case.toml", CASE.replace("iterations = 3", "iterations = 1000\ntolerance = 0.0"))
        results = self.folder / "results"
        with subprocess.Popen([program, "run", case, "--output", results, "--events", "json"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True, env=support.one_thread_each()) as process:
            lines = []
            for line in process.stdout:  # each arrives at once, though standard output is a pipe
                lines.append(line)
                if json.loads(line) == {"event": "checkpoint", "iteration": 0}:
                    process.send_signal(signal.SIGTERM)
        events = [json.loads(line) for line in lines]
        self.assertEqual(process.returncode, 143)
        self.assert_events(events, 143)
        self.assertEqual(events[-1]["reason"], "stop_requested")

    def test_check_tells_problems_and_derived_numbers(self):
        good = run("check", self.write("good.toml", CASE), "--json")
        self.assertEqual(good.returncode, 0)
        checked = json.loads(good.stdout)
        validator("check").validate(checked)
        self.assertEqual(checked["problems"], [])
        self.assertAlmostEqual(checked["derived"]["narrowest_gap_m"], 0.06, delta=5e-4)
        self.assertEqual(checked["derived"]["positions_per_sector"], 2)

        text = CASE.replace("sectors = 8", "sectors = 0").replace("radius = 0.03", "radius = 0.03\ndepth = 1")
        bad = run("check", self.write("bad.toml", text), "--json")
        self.assertEqual(bad.returncode, 2)
        checked = json.loads(bad.stdout)
        validator("check").validate(checked)
        self.assertEqual(checked["derived"], None)
        lines = text.splitlines()
        self.assertEqual({(problem["kind"], problem["line"]) for problem in checked["problems"]},
                         {("out_of_range", lines.index("sectors = 0") + 1), ("unknown_key", lines.index("depth = 1") + 1)})

    def test_check_tells_that_material_is_loose(self):
        circle = '[[shape.circle]]\ncenter_radius = 0.27\ncount = 8\nradius = {}\n{}'
        text = CASE.replace(CASE[CASE.index("[[holes"):CASE.index("[grid]")],
                            circle.format(0.045, "") + circle.format(0.02, 'as = "material"\n'))
        loose = run("check", self.write("loose.toml", text), "--json")
        self.assertEqual(loose.returncode, 2, loose.stdout)
        checked = json.loads(loose.stdout)
        validator("check").validate(checked)
        self.assertGreater(len(checked["problems"]), 0)

    def test_analyze_and_compare_print_what_their_schemas_say(self):
        case, results = self.write("case.toml", CASE), self.folder / "results"
        self.assertEqual(run("run", case, "--output", results).returncode, 0)
        analysis = json.loads(run("analyze", results, "--positions", 4, "--loads", "1000,2000", "--json").stdout)
        validator("analysis").validate(analysis)
        self.assertEqual((len(analysis["positions"]), len(analysis["loads"])), (4, 2))
        comparison = json.loads(run("compare", case, results, "--positions", 4, "--json").stdout)
        validator("comparison").validate(comparison)
        self.assertEqual(len(comparison["wheels"]), 2)
        first, second = comparison["wheels"]
        for undecided in comparison["within_errors"]:
            for key in undecided["numbers"]:
                self.assertLessEqual(abs(first[key] - second[key]), first["errors"][key] + second["errors"][key], key)

    def test_analyze_prints_the_same_pass_as_it_writes(self):
        ground = 'ground = "kerb"\nground_height = 0.02\nground_radius = 0.005\nground_place = 0.05\n'
        case, folder = self.write("kerb.toml", CASE.replace("[load]\n", f"[load]\n{ground}", 1)), self.folder / "pass"
        told = run("analyze", case, "--positions", 2, "--pass=-0.02,0.03,5", "--without-errors", "--json", "--output", folder)
        analysis = json.loads(told.stdout)
        validator("analysis").validate(analysis)
        self.assertEqual(analysis, json.loads((folder / "analysis.json").read_text()))
        self.assertEqual([place["moved_m"] for place in analysis["pass"]], [-0.02, 0.03, 5])
        rows = [{"moved_m": place["moved_m"], "position": k, **numbers}
                for place in analysis["pass"] for k, numbers in enumerate(place["positions"])]
        with open(folder / "pass.csv", encoding="utf-8") as file:
            self.assertEqual(rows, [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)])
        # The load is carried, and the kerb holds the wheel back, unless it is far away.
        for row in rows:
            self.assertAlmostEqual(row["force_up_N"], 2943, delta=1e-3)
            self.assertEqual(abs(row["force_along_N"]) > 1, row["moved_m"] < 1)


class Schemas(unittest.TestCase):

    def test_refuse_what_is_wrong(self):
        end = {"event": "end", "reason": "converged", "exit_code": 0, "meaning": "done"}
        validator("event").validate(end)
        for change in ({"exit_code": 77}, {"reason": "tired"}, {"event": "ending"}, {"meaning": None}):
            self.assertFalse(validator("event").is_valid({**end, **change}), change)


if __name__ == "__main__":
    unittest.main()
