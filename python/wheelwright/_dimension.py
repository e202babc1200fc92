"""The one place where the dimension of a wheel chooses classes of the library."""

from __future__ import annotations

from . import _core
from .errors import FormatError


def of(dimension: int) -> _core.Dimension:
    """The classes for wheels in 2D, or in 3D."""
    return _core.plane if dimension == 2 else _core.solid


def level_set(data: bytes) -> _core.LevelSet:
    """A level set from its bytes, in whichever dimension."""
    try:
        return _core.plane.LevelSet.from_bytes(data)
    except FormatError:
        return _core.solid.LevelSet.from_bytes(data)
