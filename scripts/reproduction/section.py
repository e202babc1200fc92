"""What the sections of the page are made of."""

import shutil
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from .plot import Curve, line_plot
from .runs import Run

Runs = dict[str, Run]


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


def verdict(holds: bool) -> str:
    return "**confirmed**" if holds else "**contradicted**"


def verdicts(*parts: tuple[str, bool]) -> str:
    """One verdict where all agree, else one for each condition."""
    if len({holds for _, holds in parts}) == 1:
        return verdict(parts[0][1])
    return ", ".join(f"{verdict(holds)} {condition}" for condition, holds in parts)


def both_ways(ours: bool, rules: bool) -> str:
    return verdicts(("at constant volume", ours), ("by the paper's rules", rules))


def percent(value: float, digits: int = 1) -> str:
    return f"{100 * value:+.{digits}f} %"


def joined(*parts: str) -> str:
    """The parts with an empty line between; paragraphs are wrapped, tables and pictures are not."""
    return "\n".join(part if part[0] in "|!" else textwrap.fill(part, 115) + "\n" for part in parts)
