"""What the sections of the page are made of."""

import shutil
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from .family import Family, Verdict
from .plot import Curve, line_plot
from .runs import Run

Runs = dict[str, Family]  # by the names of their cases


@dataclass
class Album:
    """The folder beside the page that its pictures are collected in."""

    folder: Path

    def curves(self, name: str, title: str, y_name: str, *lines: tuple[str, list[float]]) -> str:
        line_plot(self.folder / name, title, y_name, [Curve(*line) for line in lines])
        return self._picture(name, title)

    def copied(self, run: Run, file: str, text: str) -> str:
        """A picture that the run wrote; a note if a run with fewer shapes than its case's did not."""
        if not (run.folder / file).exists():
            return f"{text}: {file} was not written.\n"
        name = f"{run.name}_{Path(file).name}"
        shutil.copy(run.folder / file, self.folder / name)
        return self._picture(name, text)

    def comparison(self, run: Run, text: str) -> str:
        return self.copied(run, "comparison.svg", text)

    def remove_others_than(self, page: str) -> None:
        """Removes pictures that the page does not show any more."""
        for file in self.folder.glob("*.svg"):
            if f"({self.folder.name}/{file.name})" not in page:
                file.unlink()

    def _picture(self, name: str, text: str) -> str:
        return f"![{text}]({self.folder.name}/{name})\n"


@dataclass
class Figure:
    numbers: range  # of the paper's figures
    title: str
    cases: list[str]
    section: Callable[[Runs, Album], str]
    may_fail: tuple[str, ...] = ()  # cases whose failure the section tells
    shapes: tuple[tuple[str, str], ...] = ()  # a case and another one, whose last shape is evaluated under the first

    @property
    def label(self) -> str:
        first, last = self.numbers[0], self.numbers[-1]
        return f"{first}" if first == last else f"{first}-{last}"


def claims(*rows: tuple[str, str, str]) -> str:
    """Rows of: what the paper says, what is measured, the verdict."""
    return table(["the paper says", "measured here", "verdict"], *rows)


def table(head: list[str], *rows: tuple[str, ...]) -> str:
    lines = [" | ".join(row) for row in (head, *rows)]
    lines.insert(1, "|".join(["---"] * len(head)))
    return "".join(f"| {line} |\n" if not line.startswith("---") else f"|{line}|\n" for line in lines)


def told(verdict: Verdict) -> str:
    return f"**{verdict.value}**"


def verdicts(*parts: tuple[str, Verdict]) -> str:
    """One verdict where all agree, else one for each condition."""
    if len({verdict for _, verdict in parts}) == 1:
        return told(parts[0][1])
    return ", ".join(f"{told(verdict)} {condition}" for condition, verdict in parts)


def both_ways(ours: Verdict, rules: Verdict) -> str:
    return verdicts(("at constant volume", ours), ("by the paper's rules", rules))


def sizes(family: Family) -> str:
    """Length by width of every kind of hole of the last shape, from the axle outwards."""
    counts = family.of(lambda run: len(run.holes))
    if counts.low != counts.high:
        return f"{counts.text(0)} kinds of holes"
    kinds = []
    for k in range(len(family.run.holes)):
        length, width = (family.of(lambda run: getattr(run.holes[k], size)) for size in ("length", "width"))
        kinds.append(f"{length.text(1)} x {width.text(1)}")
    return ", ".join(kinds) + " mm"


def ways(ours: str, rules: str) -> str:
    """What is measured of the one and of the other."""
    return f"{ours}; by the paper's rules {rules}"


def joined(*parts: str) -> str:
    """The parts with an empty line between; paragraphs are wrapped, tables, pictures and commands are not."""
    return "\n".join(part if part[0] in "|! " else textwrap.fill(part, 115) + "\n" for part in parts)
