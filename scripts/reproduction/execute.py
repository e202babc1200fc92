"""Runs cases of the paper with the built program, those by the paper's rules with perturbed copies."""

import json
import os
import re
import shutil
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from .family import Family
from .progress import CaseProgress
from .runs import Run

cases = Path("cases/paper")
expectations_unmet = 7  # exit code of the program
perturbations = [sign * size * 1e-6 for size in (1, 3, 6, 10) for sign in (1, -1)]  # of the holes' radius, relative


@dataclass
class Task:
    """A run to be made: of a case, of its perturbation number `perturbation`, or of the last shape of the case `shape`
    as the first and only one of this case."""

    case: str
    perturbation: int | None = None
    shape: str | None = None

    @property
    def family(self) -> str:
        """The name under which its results are found."""
        return self.case if self.shape is None else f"{self.case}_of_{self.shape}"

    @property
    def name(self) -> str:
        return self.family if self.perturbation is None else f"{self.family}_{self.perturbation + 1}"

    def case_file(self, folder: Path) -> Path:
        """The file to run; that of a changed case is written to `folder`."""
        file = cases / f"{self.case}.toml"
        if self.perturbation is None and self.shape is None:
            return file
        copy = folder / f"{self.name}.toml"
        text = file.read_text()
        if self.perturbation is not None:
            text = perturbed(text, perturbations[self.perturbation])
        if self.shape is not None:
            text = of_shape(text, self.shape)
        copy.write_text(text)
        return copy


def follows_rounding(case: str) -> bool:
    """Whether the case is run by the paper's rules, which amplify rounding errors."""
    return re.search(r'^control = "paper"', case, re.MULTILINE) is not None


def perturbed(case: str, relative: float) -> str:
    """The case with other radii of its holes, without expected values and pictures."""
    case = re.sub(r"^\[\[expect\]\].*", "", case, flags=re.MULTILINE | re.DOTALL)
    case = re.sub(r"^\[output\]\n([^\[]*\n)?", "", case, flags=re.MULTILINE)
    changed = lambda m: f"radius = {float(m[1]) * (1 + relative):.12g}"  # noqa: E731
    case = re.sub(r"^radius = (\S+)", changed, case, flags=re.MULTILINE)
    return case + "\n[output]\nvtu_every = 0\n"


def of_shape(case: str, run: str) -> str:
    """The case of the shape of a run in the folder beside, in place of its holes, without expected values."""
    case = re.sub(r"^\[\[expect\]\].*", "", case, flags=re.MULTILINE | re.DOTALL)
    case = re.sub(r"^\[\[holes\.\w+\]\]\n([^\[]*\n)?", "", case, flags=re.MULTILINE)
    case = re.sub(r"^iterations = .*", "iterations = 0", case, flags=re.MULTILINE)
    return case + f'\n[shape]\nfrom = "{run}"\n'


def tasks_of(case: str) -> list[Task]:
    tasks = [Task(case)]
    if follows_rounding((cases / f"{case}.toml").read_text()):
        tasks += [Task(case, k) for k in range(len(perturbations))]
    return tasks


def execute(program: str, task: Task, folder: Path, options: list[str]) -> Run:
    """Makes a run in `folder`/NAME, replacing what an earlier call left there."""
    output = folder / task.name
    shutil.rmtree(output, ignore_errors=True)
    ended = _ended([program, "run", str(task.case_file(folder)), "--output", str(output), *options])
    run = Run(task.name, output, ended.seconds)
    said_by = "wheelwright: "
    complaints = [line.removeprefix(said_by) for line in ended.errors.splitlines() if line.startswith(said_by)]
    if ended.code == expectations_unmet:
        run.unmet = [line for line in complaints if ", expected " in line]
    elif ended.code != 0:
        run.failure = complaints[-1] if complaints else f"exit code {ended.code}"
    found = re.search(r"^expected +(\d+) of (\d+) values", ended.output, re.MULTILINE)
    if found:
        run.expected = int(found[2])
    return run


@dataclass
class _Ended:
    """A program that ended."""

    code: int
    seconds: float  # of processor time
    output: str
    errors: str


def _ended(command: list[str]) -> _Ended:
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=output, stderr=errors)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        errors.seek(0)
        return _Ended(
            process.returncode, usage.ru_utime + usage.ru_stime, output.read().decode(), errors.read().decode()
        )


class Records:
    """What became of finished runs, so that a call can continue an earlier one."""

    def __init__(self, program: str, folder: Path, options: list[str]):
        self._folder = folder
        self._made_by = [Path(program).stat().st_mtime, *options]

    def keep(self, task: Task, run: Run) -> None:
        record = {"made_by": self._of(task), "seconds": run.seconds, "failure": run.failure, "unmet": run.unmet,
                  "expected": run.expected}
        self._file(task).write_text(json.dumps(record))

    def find(self, task: Task) -> Run | None:
        """The finished run of this task, if program, case and options are the same."""
        if not self._file(task).exists():
            return None
        record = json.loads(self._file(task).read_text())
        if record.pop("made_by") != self._of(task):
            return None
        return Run(task.name, self._folder / task.name, **record)

    def _of(self, task: Task) -> list:
        return [*self._made_by, task.case_file(self._folder).read_text()]

    def _file(self, task: Task) -> Path:
        return self._folder / f"{task.name}.json"


def execute_all(program: str, tasks: list[Task], folder: Path, options: list[str], jobs: int, reuse: bool,
                progress: CaseProgress) -> dict[str, Family]:
    """All tasks, `jobs` at a time, as the families of their cases; the result is the same however many. `reuse`:
    whether runs that an earlier call finished are not made again."""
    folder.mkdir(parents=True, exist_ok=True)
    records = Records(program, folder, options)

    def one(task: Task) -> Run:
        progress.started(task.name)
        run = records.find(task) if reuse else None
        if run is None:
            run = execute(program, task, folder, options)
            records.keep(task, run)
        progress.finished(task.name, run.failure or "; ".join(run.unmet))
        return run

    families: dict[str, Family] = {}
    # Those that need the shapes of others come last.
    for part in ([t for t in tasks if t.shape is None], [t for t in tasks if t.shape is not None]):
        with ThreadPoolExecutor(jobs) as pool:
            for task, run in zip(part, pool.map(one, part)):
                families.setdefault(task.family, Family(task.family, [])).members.append(run)
    return families
