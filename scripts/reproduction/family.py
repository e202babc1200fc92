"""Runs of one case that differ by nothing but rounding, and claims about all of them.

By the paper's rules the shape depends on rounding after a few dozen steps: another processor, whose BLAS adds in
another order, finds another shape. A claim about such a run is one about all of its family, whose members begin with
holes that differ by less than a micrometre."""

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from .runs import Run


class Verdict(Enum):
    confirmed = "confirmed"
    contradicted = "contradicted"
    undecided = "undecided"


class Values(list[float]):
    """What was measured: one number, or one of every run of a family, or of every combination of several."""

    @property
    def low(self) -> float:
        return min(self)

    @property
    def high(self) -> float:
        return max(self)

    @property
    def mean(self) -> float:
        return sum(self) / len(self)

    def text(self, decimals: int, unit: str = "", sign: str = "") -> str:
        """The number; or the range, rounded outwards to at most so many decimals, and to no more than 50 steps
        of the last digit: further ones would be others in other runs. `sign`: "+" to print the sign of positive numbers too."""
        if self.high > self.low:
            decimals = max(0, min(decimals, math.floor(-math.log10((self.high - self.low) / 50))))
            power = 10**decimals
            numbers = [math.floor(self.low * power) / power, math.ceil(self.high * power) / power]
        else:
            numbers = [self.low]
        texts = dict.fromkeys(f"{number or 0.0:{sign if number else ''}.{decimals}f}" for number in numbers)
        return " to ".join(texts) + (unit and f" {unit}")

    def percent(self, decimals: int = 1, sign: str = "") -> str:
        """The text of a fraction."""
        return Values(100 * value for value in self).text(decimals, "%", sign)

    def change(self, decimals: int = 1) -> str:
        """The text of a relative change."""
        return self.percent(decimals, "+")


@dataclass
class Family:
    """The runs of a case: of the case itself, and then, if it depends on rounding, of its perturbations."""

    name: str
    members: list[Run]

    @property
    def run(self) -> Run:
        """That of the case itself."""
        return self.members[0]

    @property
    def failure(self) -> str | None:
        """Why a member gave up; none if none did."""
        return next((run.failure for run in self.members if run.failure), None)

    def of(self, quantity: Callable[[Run], float]) -> Values:
        return over(quantity, self)

    def last(self, column: str) -> Values:
        """Of the last shape."""
        return self.of(lambda run: run.last[column])

    def change(self, column: str) -> Values:
        """From the first shape to the last, relative."""
        return self.of(lambda run: run.change(column))


def over(quantity: Callable[..., float], *families: Family) -> Values:
    """A quantity of one run of every family, in all combinations: nothing pairs the runs of two families."""
    return Values(quantity(*runs) for runs in itertools.product(*(family.members for family in families)))


def judged(holds: Callable[[float], bool], values: Values) -> Verdict:
    """Of a claim that a number can meet: undecided if some of the values meet it and others do not."""
    found = {holds(value) for value in values}
    if len(found) > 1:
        return Verdict.undecided
    return Verdict.confirmed if found == {True} else Verdict.contradicted


def both(*verdicts: Verdict) -> Verdict:
    """Of a claim with several conditions."""
    for verdict in (Verdict.contradicted, Verdict.undecided):
        if verdict in verdicts:
            return verdict
    return Verdict.confirmed
