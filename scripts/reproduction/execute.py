"""Runs cases of the paper with the built program, those by the paper's rules with perturbed copies."""

import re
import shutil
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from .family import Family
from .progress import CaseProgress
from .runs import Run

cases = Path("cases/paper")
expectations_unmet = 7  # exit code of the program
perturbations = [1e-6, -1e-6, 3e-6, -3e-6, 6e-6, -6e-6, 1e-5, -1e-5]  # of the holes' radius, relative


@dataclass
class Task:
    """A run to be made: of a case, or of its perturbation number `perturbation`."""

    case: str
    perturbation: int | None = None

    @property
    def name(self) -> str:
        return self.case if self.perturbation is None else f"{self.case}_{self.perturbation + 1}"

    def case_file(self, folder: Path) -> Path:
        """The file to run; that of a perturbed case is written to `folder`."""
        file = cases / f"{self.case}.toml"
        if self.perturbation is None:
            return file
        copy = folder / f"{self.name}.toml"
        copy.write_text(perturbed(file.read_text(), perturbations[self.perturbation]))
        return copy


def follows_rounding(case: str) -> bool:
    """Whether the case is run by the paper's rules, which amplify rounding errors."""
    return re.search(r'^control = "paper"', case, re.MULTILINE) is not None


def perturbed(case: str, relative: float) -> str:
    """The case with other radii of its holes, without expected values and pictures."""
    case = re.sub(r"^\[\[expect\]\].*", "", case, flags=re.MULTILINE | re.DOTALL)
    case = re.sub(r"^\[output\]\n([^\[]*\n)?", "", case, flags=re.MULTILINE)
    case = re.sub(r"^radius = (\S+)", lambda m: f"radius = {float(m[1]) * (1 + relative):.12g}", case, flags=re.MULTILINE)
    return case + "\n[output]\nvtu_every = 0\n"


def tasks_of(case: str) -> list[Task]:
    tasks = [Task(case)]
    if follows_rounding((cases / f"{case}.toml").read_text()):
        tasks += [Task(case, k) for k in range(len(perturbations))]
    return tasks


def execute(program: str, task: Task, folder: Path, options: list[str]) -> Run:
    """Makes a run in `folder`/NAME, replacing what an earlier call left there."""
    output = folder / task.name
    shutil.rmtree(output, ignore_errors=True)
    start = time.monotonic()
    result = subprocess.run(
        [program, "run", str(task.case_file(folder)), "--output", str(output), *options],
        capture_output=True,
        text=True,
    )
    run = Run(task.name, output, time.monotonic() - start)
    said_by = "wheelwright: "
    complaints = [
        line.removeprefix(said_by) for line in result.stderr.splitlines() if line.startswith(said_by)
    ]
    if result.returncode == expectations_unmet:
        run.unmet = [line for line in complaints if ", expected " in line]
    elif result.returncode != 0:
        run.failure = complaints[-1] if complaints else f"exit code {result.returncode}"
    found = re.search(r"^expected +(\d+) of (\d+) values", result.stdout, re.MULTILINE)
    if found:
        run.expected = int(found[2])
    return run


def execute_all(program: str, tasks: list[Task], folder: Path, options: list[str], jobs: int,
                progress: CaseProgress) -> dict[str, Family]:
    """All tasks, `jobs` at a time, as the families of their cases; the result is the same however many."""
    folder.mkdir(parents=True, exist_ok=True)

    def one(task: Task) -> Run:
        progress.started(task.name)
        run = execute(program, task, folder, options)
        progress.finished(task.name, run.failure or "; ".join(run.unmet))
        return run

    families: dict[str, Family] = {}
    with ThreadPoolExecutor(jobs) as pool:
        for task, run in zip(tasks, pool.map(one, tasks)):
            families.setdefault(task.case, Family(task.case, [])).members.append(run)
    return families
