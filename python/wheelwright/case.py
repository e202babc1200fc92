"""Cases: a wheel, its load, and what is optimized."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Union

from . import _core
from .functionals import OwnFunctional

Value = Union[bool, int, float, str, Sequence[float], Sequence[Sequence[float]], None]
"""A value of a key: as in a case file, ``"300 mm"`` too. None: the key is absent, with its default."""


_WEIGHTS = ("strain_energy", "uniformity_l2", "uniformity_annulus", "uniformity_dual")
"""The quantities whose weights have keys of their own."""


def _toml(value: Value) -> str:
    if value is None:
        return ""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(float(value))
    if hasattr(value, "item") and not hasattr(value, "__len__"):
        return _toml(value.item())
    return "[" + ", ".join(_toml(one) for one in value) + "]"


class Case:
    """A wheel, its loads, its grid, and what is optimized: the content of a case file.

    ``case["load.mass"]`` is the value of a key in the unit of the case file, and ``case["load.mass"] = 60``
    sets it; tables of arrays count from 1: ``case["holes.ring[1].radius"]``. The reference of all keys is
    docs/case-reference.md. A Case is always valid: setting a key to a value that contradicts others raises a
    :class:`CaseError` and changes nothing. :meth:`replace` sets several keys at once.

    Args:
        file: a case file, or the folder of a run.
        functionals: own quantities (:class:`Functional`, :class:`MaterialDensity`, :class:`EdgeDensity`) that
            the case may name.

    Raises:
        CaseError: with all mistakes and their lines.
    """

    def __init__(self, file: str | PathLike[str], functionals: Iterable[OwnFunctional] = ()) -> None:
        path = Path(file)
        if path.is_dir():
            path = path / "case.toml"
        self._set(path.read_text(encoding="utf-8"), str(path), tuple(functionals))

    def _set(self, text: str, file: str, functionals: tuple[OwnFunctional, ...]) -> None:
        self._core = _core.Case(text, file, list(functionals))
        self._text, self._file, self._functionals = text, file, functionals

    @classmethod
    def parse(
        cls, text: str, functionals: Iterable[OwnFunctional] = (), file: str | PathLike[str] = "case.toml"
    ) -> Case:
        """A case from the text of a case file.

        ``file`` is its name in messages; drawings are read relative to its folder.
        """
        case = cls.__new__(cls)
        case._set(text, str(file), tuple(functionals))
        return case

    @classmethod
    def preset(cls, name: str, functionals: Iterable[OwnFunctional] = ()) -> Case:
        """One of :func:`presets`."""
        return cls.parse(_core.preset(name), functionals, f"{name}.toml")

    @property
    def text(self) -> str:
        """The case file as it was given, with the keys that were set since."""
        return self._text

    @property
    def resolved(self) -> str:
        """A case file with every value written out."""
        return self._core.resolved

    @property
    def functionals(self) -> tuple[OwnFunctional, ...]:
        """The own quantities that the case may name."""
        return self._functionals

    @property
    def dimension(self) -> int:
        """2, or 3 with the width of the wheel."""
        return self._core.dimension

    @property
    def warnings(self) -> list[str]:
        """Doubtful values, one readable line each."""
        return self._core.warnings()

    def __getitem__(self, key: str) -> Any:
        text = self._core.key(key)
        return tomllib.loads("value = " + text)["value"] if text else None

    def __setitem__(self, key: str, value: Value) -> None:
        changed = self.replace({key: value})
        self._set(changed._text, changed._file, changed._functionals)

    def replace(self, keys: Mapping[str, Value]) -> Case:
        """The case with other values of some keys.

        A table that is missing is added; of an array, the one after its last. Keys that replace each other,
        such as ``load.mass`` and ``load.force``, do so.
        """
        text = _core.with_keys(self._text, [(key, _toml(value)) for key, value in keys.items()])
        return Case.parse(text, self._functionals, self._file)

    def with_functionals(self, *functionals: OwnFunctional) -> Case:
        """The case with further own quantities that it may name."""
        return Case.parse(self._text, self._functionals + functionals, self._file)

    def minimize(self, what: str | Mapping[str, float]) -> Case:
        """The case that minimizes a quantity, or a sum of quantities with weights.

        ``{"pressure_squared": 2e-9}`` adds a term to the case's sum, in which the strain energy has the
        weight 1 unless the case, or ``{"strain_energy": 0, ...}``, says otherwise.
        """
        if isinstance(what, str):
            return self.replace({"objective.minimize": what})
        keys: dict[str, Value] = {}
        n = self._count("objective", "term")
        for quantity, weight in what.items():
            if quantity in _WEIGHTS:
                keys[f"objective.{quantity}"] = weight
            else:
                n += 1
                keys[f"objective.term[{n}].quantity"] = quantity
                keys[f"objective.term[{n}].weight"] = weight
        return self.replace(keys)

    def bound(
        self,
        quantity: str,
        *,
        at_most: float | str | None = None,
        at_least: float | str | None = None,
        equals: float | str | None = None,
        **keys: Value,
    ) -> Case:
        """The case with a further ``[[constraint]]``; ``keys`` are other keys of its table, such as ``over``."""
        table = f"constraint[{self._count('constraint') + 1}]"
        values: dict[str, Value] = {"quantity": quantity, "at_most": at_most, "at_least": at_least}
        values |= keys | {"equals": equals}
        return self.replace({f"{table}.{key}": value for key, value in values.items() if value is not None})

    def _count(self, *path: str) -> int:
        node: Any = tomllib.loads(self._text)
        for name in path:
            node = node.get(name, {})
        return len(node)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Case):
            return NotImplemented
        return self.resolved == other.resolved and self._functionals == other._functionals

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<Case {self._file}, {self.dimension}D>"

    def __getstate__(self) -> tuple[str, str, tuple[OwnFunctional, ...]]:
        return self._text, self._file, self._functionals

    def __setstate__(self, state: tuple[str, str, tuple[OwnFunctional, ...]]) -> None:
        self._set(*state)


def presets() -> dict[str, str]:
    """The names of the wheels to start from, and what each of them is."""
    return dict(_core.presets())
