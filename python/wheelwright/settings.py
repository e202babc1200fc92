"""What determines speed and last digits on this machine."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import NamedTuple

from . import _core


class Settings(NamedTuple):
    """What determines the last digits of results."""

    version: str
    """Of the library."""
    kernels: str
    """Of OpenBLAS, such as ``SkylakeX``; results have the same bytes where these are the same. Whoever loads
    OpenBLAS first chooses them: import wheelwright before numpy to have those of the program."""
    blas_threads: int
    """Of OpenBLAS outside of this package. Computations of this package always use one, and share their work
    out themselves (:func:`limit_threads`)."""


def settings() -> Settings:
    """The settings of this process."""
    return Settings(_core.version(), _core.blas_kernels(), _core.blas_threads())


@contextlib.contextmanager
def limit_threads(n: int) -> Iterator[None]:
    """While this context is open, computations use at most ``n`` threads; otherwise one per processor."""
    if n < 1:
        raise ValueError(f"expected at least 1 thread, not {n}")
    limit = _core.ThreadLimit(n)
    try:
        yield
    finally:
        del limit
