"""Usage: python3 -m reproduction PROGRAM [FIGURE...]; from the repository's top folder."""

import re
import subprocess
import sys
from pathlib import Path

from .figures import Figure, Runs, figures, pictures
from .runs import execute

page = Path("docs/reproduction.md")


def chosen(arguments: list[str]) -> list[Figure]:
    """The figures that numbers and ranges such as 16-21 name; all if there are none."""
    wanted: set[int] = set()
    for argument in arguments:
        match = re.fullmatch(r"(\d+)(?:-(\d+))?", argument)
        numbers = range(int(match[1]), int(match[2] or match[1]) + 1) if match else ()
        if not any(n in figure.numbers for figure in figures for n in numbers):
            sys.exit(f"{argument}: no such figure; there are {', '.join(f.label for f in figures)}")
        wanted.update(numbers)
    return [f for f in figures if not wanted or wanted.intersection(f.numbers)]


def run_all(program: str, selection: list[Figure]) -> Runs:
    names = list(dict.fromkeys(name for figure in selection for name in figure.cases))
    return {name: execute(program, name, f"[{k}/{len(names)}]") for k, name in enumerate(names, 1)}


def section(figure: Figure, runs: Runs) -> str:
    mine = {name: runs[name] for name in figure.cases}
    commands = "".join(f"    wheelwright run cases/paper/{n}.toml  # {r.seconds:.0f} s\n" for n, r in mine.items())
    failures = [r for r in mine.values() if r.failure and r.name not in figure.may_fail]
    body = "".join(f"Not reproduced, {r.name}: `{r.failure}`\n" for r in failures) or figure.section(mine)
    plural = "s" if len(figure.numbers) > 1 else ""
    return f"## Fig{plural}. {figure.label}: {figure.title}\n\n{body}\n{commands}"


def earlier_sections() -> dict[str, str]:
    text = page.read_text() if page.exists() else ""
    return dict(re.findall(r"<!-- figure (\S+) -->\n(.*?)\n<!-- end -->", text, re.DOTALL))


def summary(sections: dict[str, str]) -> str:
    text = "".join(sections.values())
    result = f"{text.count('**confirmed**')} claims are confirmed, {text.count('**contradicted**')} contradicted"
    rows = re.findall(r"^\| (.*) \| (.*) \| (.*\*\*contradicted\*\*.*) \|$", text, re.MULTILINE)
    if not rows:
        return result + "."
    return result + ":\n\n" + "\n".join(
        f"- {paper}: {verdict.replace('**', '')}; {measured}" for paper, measured, verdict in rows
    )


def write_page(sections: dict[str, str], version: str) -> None:
    head = f"""# The paper's figures, reproduced

<!-- Written by scripts/reproduce with its pictures: do not edit. -->

`scripts/reproduce` runs the cases of the paper's numerical experiments and writes this page; `scripts/reproduce 9
16-21` does so for some figures. The paper gives few numbers, so each of its statements stands beside what was
measured, and the verdict is computed from that. Sums are over the 8 load positions of one sector. Last written by
{version}.

{summary(sections)}
"""
    parts = [
        f"<!-- figure {figure.label} -->\n{sections[figure.label]}\n<!-- end -->"
        for figure in figures
        if figure.label in sections
    ]
    page.write_text(head + "\n" + "\n\n".join(parts) + "\n")


def main(program: str, arguments: list[str]) -> None:
    selection = chosen(arguments)
    pictures.mkdir(parents=True, exist_ok=True)
    runs = run_all(program, selection)
    sections = earlier_sections()
    sections.update({figure.label: section(figure, runs) for figure in selection})
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    write_page(sections, version)
    print(f"{page}: {sum(run.seconds for run in runs.values()):.0f} s of runs")


main(sys.argv[1], sys.argv[2:])
