import collections
import csv
import importlib.util
import multiprocessing
import os
import pickle
import re
import signal
import tempfile
import unittest
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from unittest import mock

import wheelwright as ww
from wheelwright import _core, _pieces
from wheels import small

TABLES = ("explore.html", "explore.csv", "explore.json", "pareto.svg")
SPAWN = multiprocessing.get_context("spawn")


def without_times(file):
    """The content of a run's file, without its times."""
    if file.name == "history.csv":
        rows = list(csv.reader(file.read_text().splitlines()))
        kept = [k for k, name in enumerate(rows[0]) if not name.endswith(" [s]")]
        return [[row[k] for k in kept] for row in rows]
    content = file.read_bytes()
    return re.sub(rb'"seconds":[^,]*,', b"", content) if file.name == "report.html" else content


def is_result(file):
    is_of_plan = file.suffix == ".toml" and file.parent.name == "designs"
    is_list = file.suffix == ".lock" or file.name == "written-by-wheelwright.txt"
    return not (is_of_plan or is_list or "checkpoints" in file.parts)


class BlindPool(ProcessPoolExecutor):
    """Whose tasks do not contain the path of the results."""

    def __init__(self, folder, n):
        super().__init__(n, mp_context=SPAWN)
        self._path = str(folder).encode()

    def submit(self, fn, /, *args, **kwargs):
        if self._path in pickle.dumps((args, kwargs)):
            raise AssertionError("a worker was told where the results are")
        return super().submit(fn, *args, **kwargs)


class Pieces(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.case = small().replace({"optimizer.iterations": 18})
        self.told = []

    def explored(self, name, **settings):
        return ww.explore(self.case, self.folder / name, starts=4, **settings)

    def by(self, client, name="sent", seconds=0.0):
        return self.explored(name, client=client, checkpoint_seconds=seconds, on_progress=self.told.append)

    def expect_equal(self, one, other):
        """Tables, picture and page, and all files of all runs but checkpoints and times."""
        for name in TABLES:
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)
        results, others = (
            {file.relative_to(folder): file for file in folder.rglob("*") if file.is_file() and is_result(file)}
            for folder in (one / "designs", other / "designs")
        )
        self.assertEqual({*results}, {*others})
        for path, file in results.items():
            self.assertEqual(without_times(file), without_times(others[path]), path)

    def test_give_the_results_of_one_process(self):
        alone = self.explored("alone")
        with BlindPool(self.folder, 2) as pool:
            self.assertEqual(self.by(pool), alone)
        self.expect_equal(self.folder / "alone", self.folder / "sent")
        # At 0 seconds each shape is a piece, so that every shape was sent by another task.
        first = [one.shape for one in self.told if (one.design, one.progression) == ("001", "preview")]
        self.assertEqual(first, list(range(16)))
        self.assertEqual(self.told[-1].n_left, 0)

    def test_of_a_sweep(self):
        values = {"load.mass": [200, 300]}
        case = small()
        alone = ww.sweep(case, self.folder / "alone", values)
        with ThreadPoolExecutor(2) as pool:
            self.assertEqual(ww.sweep(case, self.folder / "sent", values, client=pool), alone)

    def test_are_tried_again(self):
        run_piece, n_calls = _pieces.run_piece, collections.Counter()

        def flaky(files, name, *arguments):
            n_calls[name] += 1
            if n_calls[name] % 3 != 0:
                raise OSError("no space on this worker")
            return run_piece(files, name, *arguments)

        alone = self.explored("alone")
        with ThreadPoolExecutor(1) as pool, mock.patch.object(_pieces, "run_piece", flaky):
            self.assertEqual(self.by(pool, seconds=60), alone)

    def test_that_fail_again_and_again_raise(self):
        def broken(*arguments):
            raise OSError("no space on any worker")

        with ThreadPoolExecutor(1) as pool, mock.patch.object(_pieces, "run_piece", broken):
            with self.assertRaisesRegex(OSError, "no space"):
                self.by(pool)
        with ProcessPoolExecutor(1, mp_context=SPAWN) as pool, self.assertRaises(BrokenExecutor):
            pool.submit(os._exit, 1).exception()
            self.by(pool)

    def test_continue_after_the_program_that_gives_them_ended(self):
        def die(progress):
            if progress.shape == 7:
                raise ArithmeticError("own")

        alone = self.explored("alone")
        with ThreadPoolExecutor(2) as pool, self.assertRaises(ArithmeticError):
            self.explored("sent", client=pool, checkpoint_seconds=0, on_progress=die)
        rows = (self.folder / "sent/designs/001/history.csv").read_bytes().splitlines()
        self.assertEqual(self.explored("sent"), alone)
        after = (self.folder / "sent/designs/001/history.csv").read_bytes().splitlines()
        self.assertEqual(after[: len(rows)], rows)
        self.expect_equal(self.folder / "alone", self.folder / "sent")

    def test_of_designs_that_another_process_runs_are_refused(self):
        with ThreadPoolExecutor(1) as pool:
            self.by(pool)
            for file in (self.folder / "sent/designs").glob("*.json"):
                file.unlink()
            where = str(self.folder / "sent")
            lock = _core.lock_design(where, _core.plan_in(where), "002")
            with self.assertRaises(ww.RunError) as caught:
                self.by(pool)
            self.assertEqual(caught.exception.reason, "folder_in_use")
            del lock
            self.by(pool)
        with self.assertRaises(ValueError), ThreadPoolExecutor(1) as pool:
            self.explored("both", client=pool, executor=pool)

    @unittest.skipUnless(importlib.util.find_spec("distributed"), "python3-distributed is not installed")
    def test_of_killed_workers_of_dask_lose_at_most_themselves(self):
        """Rows of the history hold times, so that equal rows were not computed again."""
        from distributed import Client

        self.case = self.case.replace({"optimizer.iterations": 60})
        alone, killed = self.explored("alone"), []

        def kill(progress):
            self.told.append(progress)
            if progress.shape is None or progress.shape % 12 != 9 or len(killed) > 4:
                return
            rows = {
                run: (run / "history.csv").read_bytes()
                for run in (self.folder / "sent/designs").iterdir()
                if (run / "history.csv").exists()
            }
            for worker in client.run(os.getpid).values():
                os.kill(worker, signal.SIGKILL)
            killed.append(rows)

        with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
            sent = self.explored("sent", client=client, checkpoint_seconds=0.01, on_progress=kill)
        self.assertEqual(sent, alone)
        self.expect_equal(self.folder / "alone", self.folder / "sent")
        self.assertGreater(len(killed), 2)
        for rows in killed:
            for run, before in rows.items():
                self.assertTrue((run / "history.csv").read_bytes().startswith(before), run)


if __name__ == "__main__":
    unittest.main()
