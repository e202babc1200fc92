"""The exceptions of this package."""

from typing import NamedTuple


class Error(Exception):
    """The base of all errors of this package."""


class ComputationError(Error):
    """A shape cannot be computed, for example because a hole reaches the tread, or contact does not converge.

    ``reason`` is a word such as ``"disconnected_material"`` or ``"newton_stalled"``, the same as in history
    files; ``detail`` says where, by how much, and what would help.
    """

    def __init__(self, reason: str, detail: str) -> None:
        super().__init__(reason, detail)
        self.reason = reason
        self.detail = detail

    def __str__(self) -> str:
        return f"{self.reason}: {self.detail}"


class Problem(NamedTuple):
    """A mistake in a case."""

    kind: str
    file: str
    line: int
    """From 1; 0 if the mistake has no place."""
    column: int
    key: str
    """Its path, such as ``holes.ring[2].count``; may be empty."""
    value: str
    problem: str
    remedy: str
    text: str
    """All of this on one line."""


class CaseError(Error, ValueError):
    """A case with mistakes: all of them, with their lines, in ``problems``."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__(problems)
        self.problems = problems

    def __str__(self) -> str:
        return "\n".join(problem.text for problem in self.problems)


class UnknownKeyError(Error, KeyError):
    """A case has no such key."""

    def __str__(self) -> str:
        return str(self.args[0])


class FormatError(Error, ValueError):
    """Bytes are not those of a shape, an evaluation or a state."""


class RunError(Error):
    """A run cannot begin in its folder, or go on there.

    ``reason`` is one of ``folder_in_use``, ``folder_holds_a_run``, ``foreign_files``, ``checkpoints_gone``,
    ``no_usable_checkpoint``, ``checkpoint_misfit``, ``already_finished`` and ``executed``.
    """

    def __init__(self, reason: str, detail: str) -> None:
        super().__init__(reason, detail)
        self.reason = reason
        self.detail = detail

    def __str__(self) -> str:
        return self.detail


class OutputError(Error, OSError):
    """A file cannot be written."""
