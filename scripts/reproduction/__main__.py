"""Runs the cases of the paper's figures and writes the page; from the repository's top folder."""

import argparse
import os
import re
import subprocess
import sys
import textwrap
import time
from pathlib import Path

from .execute import Task, execute_all, perturbations, tasks_of
from .family import Verdict
from .figures import figures
from .progress import CaseProgress
from .section import Album, Figure, Runs


def chosen(words: list[str]) -> list[Figure]:
    """The figures that numbers and ranges such as 16-21 name; all if there are none."""
    wanted: set[int] = set()
    for word in words:
        match = re.fullmatch(r"(\d+)(?:-(\d+))?", word)
        numbers = range(int(match[1]), int(match[2] or match[1]) + 1) if match else ()
        if not any(n in figure.numbers for figure in figures for n in numbers):
            sys.exit(f"{word}: no such figure; there are {', '.join(f.label for f in figures)}")
        wanted.update(numbers)
    return [f for f in figures if not wanted or wanted.intersection(f.numbers)]


def shapes_of(figure: Figure) -> list[Task]:
    """The shapes of cases that the figure evaluates under other cases."""
    return [Task(case, shape=shape) for case, shape in figure.shapes]


def section(figure: Figure, runs: Runs, album: Album) -> str:
    mine = {name: runs[name] for name in figure.cases}
    commands = "".join(f"    wheelwright run cases/paper/{n}.toml  # {f.run.seconds:.0f} s\n" for n, f in mine.items())
    mine |= {task.family: runs[task.family] for task in shapes_of(figure)}
    failures = [f for f in mine.values() if f.failure and f.name not in figure.may_fail]
    body = "".join(f"Not reproduced, {f.name}: `{f.failure}`\n" for f in failures) or figure.section(mine, album)
    expected = sum(f.run.expected for f in mine.values())
    unmet = [line for f in mine.values() for line in f.run.unmet]
    checks = f"{expected - len(unmet)} of the {expected} values expected by these cases (`[[expect]]`) were found.\n"
    checks += "".join(f"- not found: {line}\n" for line in unmet)
    plural = "s" if len(figure.numbers) > 1 else ""
    return f"## Fig{plural}. {figure.label}: {figure.title}\n\n{body}\n{checks}\n{commands}"


def earlier_sections(page: Path) -> dict[str, str]:
    text = page.read_text() if page.exists() else ""
    return dict(re.findall(r"<!-- figure (\S+) -->\n(.*?)\n<!-- end -->", text, re.DOTALL))


def earlier_seconds(page: Path) -> dict[str, float]:
    text = page.read_text() if page.exists() else ""
    return {name: float(s) for name, s in re.findall(r"cases/paper/(\w+)\.toml  # (\d+) s", text)}


def summary(sections: dict[str, str]) -> str:
    """How many claims have which verdict; those that are not simply confirmed."""
    rows = re.findall(r"^\| (.*) \| (.*) \| (.*\*\*.*) \|$", "".join(sections.values()), re.MULTILINE)
    found = [set(re.findall(r"\*\*(\w+)\*\*", verdict)) for _, _, verdict in rows]
    count = {verdict: found.count({verdict.value}) for verdict in Verdict}
    in_part = sum(len(verdicts) > 1 and Verdict.undecided.value in verdicts for verdicts in found)
    result = (
        f"{count[Verdict.confirmed]} claims are confirmed, {count[Verdict.contradicted]} contradicted, "
        f"{count[Verdict.undecided]} undecided; {len(rows) - sum(count.values())} have several verdicts, of which "
        f"{in_part} are undecided in part"
    )
    doubtful = [row for row, verdicts in zip(rows, found) if verdicts != {Verdict.confirmed.value}]
    if not doubtful:
        return result + "."
    return result + ":\n\n" + "\n".join(
        f"- {paper}: {verdict.replace('**', '')}; {measured}" for paper, measured, verdict in doubtful
    )


def write_page(page: Path, sections: dict[str, str], last: str) -> None:
    head = f"""# The paper's figures, reproduced

<!-- Written by scripts/reproduce with its pictures: do not edit. -->

`scripts/reproduce` runs the cases of the paper's numerical experiments and writes this page. `scripts/reproduce 9
16-21` does so only for the figures named. The paper gives few numbers, so the tables compare each of its statements
with the measured result and compute the verdict from it. Sums are over the 8 load positions of one sector.

The optimization is run in two ways. *The paper's rules* are the multiplier lambda_k of section 4, the harmonic
extension of the gradient, smoothing (76) and a fixed step, and every shape is accepted. They let the volume drift, so
that much of the decrease of J_e comes from added material. *Volume held* means that every shape has the volume of the
first, the velocity is the H1 (Riesz) representative of the gradient, and a shape is rejected if its J exceeds the
minimum so far by more than 1e-4, relatively.

By the paper's rules the last shapes depend on rounding: two processors find two shapes, and so do holes whose radii
differ by a hundredth of a micrometre. Each of these cases is therefore run {1 + len(perturbations)} times, as it is and with radii changed by
1e-6 to 1e-5, relatively. The tables give the range of the results, rounded outwards. A claim is judged on all runs, in
all combinations if it compares several: it is *confirmed* if all meet it, *contradicted* if none does, and *undecided*
otherwise. Where an objective is compared with another one, each of its runs is compared with the mean of the other's.
Pictures and curves are those of the case as it is. With the volume held nothing is amplified: J_e of the last shapes is
the same to 1e-8 on two processors, and each case is run once.

{last}

{summary(sections)}
"""
    parts = [
        f"<!-- figure {figure.label} -->\n{sections[figure.label]}\n<!-- end -->"
        for figure in figures
        if figure.label in sections
    ]
    page.write_text(head + "\n" + "\n\n".join(parts) + "\n")


def arguments() -> argparse.Namespace:
    cores = len(os.sched_getaffinity(0))
    parser = argparse.ArgumentParser(prog="scripts/reproduce", description=__doc__)
    parser.add_argument("program", help=argparse.SUPPRESS)
    parser.add_argument("figures", nargs="*", metavar="FIGURE", help="figures, such as 9 or 16-21; default: all")
    parser.add_argument("--jobs", type=int, default=min(2, cores), help="runs at a time; default: %(default)s")
    parser.add_argument("--iterations", type=int, help="shapes instead of those of the cases, for a quick look")
    parser.add_argument("--reuse", action="store_true", help="do not repeat the runs of an earlier call")
    parser.add_argument("--page", type=Path, default=Path("docs/reproduction.md"), help="default: %(default)s")
    parser.add_argument("--runs", type=Path, default=Path("runs/reproduction"), help="default: %(default)s")
    return parser.parse_args()


def main() -> None:
    options = arguments()
    selection = chosen(options.figures)
    tasks = [task for name in dict.fromkeys(n for figure in selection for n in figure.cases) for task in tasks_of(name)]
    tasks += [task for figure in selection for task in shapes_of(figure)]
    album = Album(options.page.with_suffix(""))
    album.folder.mkdir(parents=True, exist_ok=True)
    run_options = [] if options.iterations is None else ["--iterations", str(options.iterations)]
    start = time.monotonic()
    before = earlier_seconds(options.page)
    expected = {task.name: before[task.case] for task in tasks if task.case in before}
    with CaseProgress([task.name for task in tasks], expected) as progress:
        runs = execute_all(options.program, tasks, options.runs, run_options, options.jobs, options.reuse, progress)
    wall = time.monotonic() - start
    used = sum(run.seconds for family in runs.values() for run in family.members)
    sections = earlier_sections(options.page)
    sections.update({figure.label: section(figure, runs, album) for figure in selection})
    version = subprocess.run([options.program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    last = (
        f"Last written by {version}: {len(tasks)} runs of {len(runs)} cases took {used:.0f} s of processor time; on "
        f"{options.jobs} idle {'core' if options.jobs == 1 else 'cores'} that is {used / options.jobs:.0f} s. The times "
        "beside the commands are those of one run."
    )
    write_page(options.page, sections, textwrap.fill(last, 115))
    album.remove_others_than(options.page.read_text())
    unmet = sum(len(family.run.unmet) for family in runs.values())
    remark = f", {unmet} expected values not found" if unmet else ""
    print(f"{options.page}: {len(tasks)} runs in {wall:.0f} s{remark}")


if __name__ == "__main__":
    main()
