import contextlib
import importlib.util
import multiprocessing
import os
import pickle
import subprocess
import sys
import signal
import tempfile
import threading
import time
import unittest
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from pathlib import Path

import numpy as np

import wheelwright as ww
from wheels import small


RING_OF_AIR = """
[[shape.annulus]]
inner_radius = 0.24
outer_radius = 0.29
as = "hole"
"""


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Optimizers(unittest.TestCase):
    def test_yield_the_shapes_of_a_run(self):
        study = ww.Study(small())
        optimizer = ww.Optimizer(study)
        shapes = list(optimizer)
        self.assertEqual([p.iteration for p in shapes], [0, 1, 2, 3, 4])
        self.assertEqual(optimizer.reason, "iterations")
        self.assertLess(shapes[-1].objective, shapes[0].objective)
        with tempfile.TemporaryDirectory() as folder:
            result = ww.Run(small(), Path(folder) / "run").execute()
            self.assertEqual(result.progress.shape, shapes[-1].shape)
            self.assertEqual(result.progress.objective, shapes[-1].objective)

    def test_go_on_from_a_pickled_state(self):
        study = ww.Study(small())
        shapes = list(ww.Optimizer(study))
        middle = pickle.loads(pickle.dumps(shapes[2]))
        rest = list(ww.Optimizer(study, middle))
        self.assertEqual([p.iteration for p in rest], [3, 4])
        self.assertEqual(rest[-1].shape, shapes[-1].shape)

    def test_tell_of_their_trials(self):
        optimizer = ww.Optimizer(ww.Study(small()))
        next(optimizer)
        next(optimizer)
        self.assertEqual(optimizer.trials[-1].verdict, "accepted")


class Runs(Folder):
    def test_call_back(self):
        shapes, events = [], []
        run = ww.Run(small(), self.folder / "run")
        result = run.execute(on_shape=shapes.append, on_event=events.append)
        self.assertEqual([p.iteration for p in shapes], [0, 1, 2, 3, 4])
        self.assertEqual(events[0]["event"], "begin")
        self.assertEqual(result.progress.objective, shapes[-1].objective)
        self.assertTrue((self.folder / "run" / "report.html").exists())
        with self.assertRaisesRegex(ww.RunError, "executed"):
            run.execute()

    def test_obey_commands(self):
        run = ww.Run(small(), self.folder / "run")
        run.send("stop")
        result = run.execute()
        self.assertEqual((result.reason, result.progress.iteration), ("stop_requested", 0))
        self.assertEqual(ww.Run.resume(self.folder / "run").execute().progress.iteration, 4)
        with self.assertRaises(ValueError):
            ww.Run(small(), self.folder / "other").send("no such command")

    def test_refuse_folders(self):
        run = ww.Run(small(), self.folder / "run")
        with self.assertRaises(ww.RunError) as caught:
            ww.Run(small(), self.folder / "run")
        self.assertEqual(caught.exception.reason, "folder_in_use")
        run.execute()
        for begin, reason in (
            (lambda: ww.Run(small(), self.folder / "run"), "folder_holds_a_run"),
            (lambda: ww.Run.resume(self.folder / "run"), "already_finished"),
        ):
            with self.assertRaises(ww.RunError) as caught:
                begin()
            self.assertEqual(caught.exception.reason, reason)

    def test_exceptions_in_callbacks_arrive_unchanged(self):
        """The run is saved, and its folder is free."""
        error = ArithmeticError("own")

        def broken(progress):
            if progress.iteration == 1:
                raise error

        with self.assertRaises(ArithmeticError) as caught:
            ww.Run(small(), self.folder / "run").execute(on_shape=broken)
        self.assertIs(caught.exception, error)
        run = ww.Run.resume(self.folder / "run")
        self.assertEqual(run.resumed_after, 1)
        self.assertEqual(run.execute().progress.iteration, 4)

    def test_failed_start_says_why(self):
        start = small().text.index("[[holes.ring]]"), small().text.index("[grid]")
        text = small().text[: start[0]] + RING_OF_AIR + small().text[start[1] :]
        result = ww.Run(ww.Case.parse(text), self.folder / "run").execute()
        self.assertEqual((result.reason, result.progress), ("failed_start", None))
        self.assertIn("tread_cut_off", result.failure)

    def test_ctrl_c_saves_first(self):
        code = (
            "import os, signal, sys\n"
            "import wheelwright as ww\n"
            "from wheels import small\n"
            "case = small().replace({'optimizer.iterations': 400})\n"
            "def interrupt(p):\n"
            "    if p.iteration == 3: os.kill(os.getpid(), signal.SIGINT)\n"
            "try: ww.Run(case, sys.argv[1]).execute(on_shape=interrupt)\n"
            "except KeyboardInterrupt: print('interrupted')\n"
            "print(ww.Run.resume(sys.argv[1], case=case).resumed_after)\n"
        )
        where = str(self.folder / "run")
        done = subprocess.run(
            [sys.executable, "-c", code, where],
            capture_output=True,
            text=True,
            timeout=60,
            cwd=Path(__file__).parent,
        )
        self.assertEqual(done.stdout.split(), ["interrupted", "3"], done.stderr)


@unittest.skipUnless("WHEELWRIGHT_PROGRAM" in os.environ, "needs the program")
class TheProgram(Folder):
    def test_writes_the_same_bytes(self):
        """With the kernels of OpenBLAS that the program chooses, which numpy has not loaded before."""
        (self.folder / "case.toml").write_text(small().text)
        code = "import wheelwright as ww; ww.Run(ww.Case('case.toml'), 'module').execute()"
        for command in (
            [os.environ["WHEELWRIGHT_PROGRAM"], "run", "case.toml", "--output", "program"],
            [sys.executable, "-c", code],
        ):
            subprocess.run(command, cwd=self.folder, check=True, capture_output=True, timeout=120)
        program, module = ({*names(self.folder / name)} for name in ("program", "module"))
        self.assertEqual(program, module)
        for name in ("shape.levelset", "summary.json", "shape.svg", "case.toml"):
            there, here = (self.folder / which / name for which in ("program", "module"))
            self.assertEqual(there.read_bytes(), here.read_bytes(), name)


def names(folder):
    """Of the files of a run, without checkpoints."""
    return (str(file.relative_to(folder)) for file in folder.rglob("*") if "checkpoints" not in file.parts)


class Designs(Folder):
    def test_are_swept(self):
        case = small().replace({"optimizer.iterations": 1})
        designs = ww.sweep(case, self.folder / "sweep", {"holes.ring[1].radius": [0.02, 0.03]})
        self.assertEqual(len(designs["designs"]), 2)
        self.assertTrue((self.folder / "sweep" / "sweep.html").exists())
        with self.assertRaisesRegex(ValueError, "stiffness"):
            ww.sweep(case, self.folder / "sweep", {"load.mass": [20]}, quantities=["beauty"])


    def test_are_explored(self):
        case = small().replace({"optimizer.iterations": 1})
        designs = ww.explore(case, self.folder / "explored", starts=2)
        self.assertEqual(len(designs["designs"]), 2)
        self.assertTrue((self.folder / "explored" / "pareto.svg").exists())

    def expect_shared_equals_alone(self, executor):
        case = small().replace({"optimizer.iterations": 3})
        alone = ww.explore(case, self.folder / "alone", starts=4)
        shared = ww.explore(case, self.folder / "shared", starts=4, executor=executor, workers=3)
        self.assertEqual(shared, alone)
        for name in ("explore.html", "explore.csv", "pareto.svg"):
            self.assertEqual((self.folder / "shared" / name).read_bytes(), (self.folder / "alone" / name).read_bytes())

    def test_are_shared_by_processes(self):
        with ProcessPoolExecutor(3, mp_context=multiprocessing.get_context("spawn")) as executor:
            self.expect_shared_equals_alone(executor)

    @unittest.skipUnless(importlib.util.find_spec("distributed"), "python3-distributed is not installed")
    def test_are_shared_by_workers_of_dask(self):
        from distributed import Client, get_task_stream

        with (
            Client(n_workers=3, threads_per_worker=1, dashboard_address=None) as client,
            get_task_stream(client=client) as tasks,
        ):
            self.expect_shared_equals_alone(client.get_executor())
        self.assertEqual(len(tasks.data), 3)  # one for each worker

    def expect_only_unsaved_shapes_to_be_lost(self, call):
        """Kills the process of a run in its middle, and lets `call` go on. The rows of the history hold times, so that
        equal rows were not computed again."""
        run, every, before = self.folder / "swept/designs/001", 5, []
        case = small().replace(
            {"optimizer.iterations": 60, "optimizer.tolerance": 0, "output.checkpoint_every": every}
        )

        def rows():
            file = run / "history.csv"
            return file.read_bytes().split(b"\n") if file.exists() else []

        def kill():
            deadline = time.monotonic() + 60
            while len(rows()) < 3 * every and time.monotonic() < deadline:
                time.sleep(0.001)
            process = int((run / "run.lock").read_text().split()[0])
            os.kill(process, signal.SIGSTOP)
            before.extend(rows())
            os.kill(process, signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        shared = call(case, self.folder / "swept", {"load.mass": [300]})
        killer.join()
        after = rows()
        n_kept = next(k for k, (one, other) in enumerate(zip(before, after, strict=False)) if one != other)
        n_lost = sum(row.split(b",")[2:3] == [b"1"] for row in before[n_kept:-1])
        self.assertGreater(len(after), len(before))
        self.assertGreater(n_kept, every)
        self.assertLessEqual(n_lost, every)
        self.assertEqual(shared, ww.sweep(case, self.folder / "alone", {"load.mass": [300]}))

    def test_continue_from_the_last_checkpoint_of_a_dead_process(self):
        def call(*arguments):
            for executor in (ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) for _ in "12"):
                with executor, contextlib.suppress(BrokenExecutor):
                    return ww.sweep(*arguments, executor=executor)

        self.expect_only_unsaved_shapes_to_be_lost(call)

    @unittest.skipUnless(importlib.util.find_spec("distributed"), "python3-distributed is not installed")
    def test_continue_from_the_last_checkpoint_of_a_dead_worker_of_dask(self):
        from distributed import Client

        with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
            self.expect_only_unsaved_shapes_to_be_lost(
                lambda *arguments: ww.sweep(*arguments, executor=client.get_executor())
            )

    def test_whose_workers_all_fail_raise(self):
        case = small().replace({"optimizer.iterations": 1})
        with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as executor:
            executor.submit(os.getpid).result()
            with self.assertRaises(BrokenExecutor):
                executor.submit(os._exit, 1).exception()
                ww.explore(case, self.folder / "failed", starts=2, executor=executor, workers=1)


class Reports(Folder):
    def test_show_runs_side_by_side(self):
        for name in ("a", "b"):
            ww.Run(small().replace({"optimizer.iterations": 1}), self.folder / name).execute()
        ww.report([self.folder / "a", self.folder / "b"], self.folder / "both.html")
        page = (self.folder / "both.html").read_text()
        self.assertIn('"name":"a"', page)
        self.assertIn('"name":"b"', page)


class Exports(Folder):
    def test_have_the_format_of_the_ending(self):
        study = ww.Study(small())
        for ending in ("dxf", "svg", "stl"):
            study.export(self.folder / f"wheel.{ending}")
            self.assertGreater((self.folder / f"wheel.{ending}").stat().st_size, 1000)
        with self.assertRaisesRegex(ValueError, "dxf"):
            study.export(self.folder / "wheel.txt")

    def test_of_extruded_wheels_are_those_of_plane_ones(self):
        solid = ww.Study(small().replace({"wheel.dimension": 3, "grid.axial_cells": 2}))
        solid.export(self.folder / "solid.dxf")
        ww.Study(small()).export(self.folder / "plane.dxf")
        sizes = [(self.folder / f"{name}.dxf").stat().st_size for name in ("solid", "plane")]
        self.assertAlmostEqual(sizes[0] / sizes[1], 1, delta=0.2)

    def test_have_the_layers_of_the_case(self):
        study = ww.Study(ww.Case.preset("caster-tyre"))
        study.export(self.folder / "wheel.dxf")
        self.assertIn("tyre", (self.folder / "wheel.dxf").read_text())

    def test_of_one_layer_hold_it_alone(self):
        """Its triangles lie in the tyre, those of the wheel do not."""
        study = ww.Study(ww.Case.preset("caster-tyre"))
        inner_radii = []
        for layer in (None, "tyre"):
            file = self.folder / "wheel.stl"
            study.export(file, layer=layer)
            triangles = np.frombuffer(file.read_bytes()[84:], dtype=[("v", "<f4", (4, 3)), ("a", "<u2")])["v"]
            inner_radii.append(1e-3 * np.hypot(triangles[:, 1:, 0], triangles[:, 1:, 1]).min())
        self.assertAlmostEqual(inner_radii[0], float(study.case["wheel.inner_radius"]), places=4)
        self.assertAlmostEqual(inner_radii[1], float(study.case["material.layer[1].inner_radius"]), places=4)
        with self.assertRaisesRegex(ValueError, "no layer band; it has material, tyre"):
            study.export(self.folder / "wheel.stl", layer="band")
        with self.assertRaisesRegex(ValueError, "of one material"):
            ww.Study(small()).export(self.folder / "wheel.stl", layer="tyre")


if __name__ == "__main__":
    unittest.main()
