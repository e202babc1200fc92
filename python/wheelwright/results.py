"""Numbers and files of a wheel."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike, fspath
from pathlib import Path
from typing import NamedTuple, Optional

import numpy as np

from . import _core
from ._dimension import of
from ._types import FloatArray
from .case import Case
from .functionals import OwnFunctional
from .shape import Shape
from .state import State


class RollingAnalysis(NamedTuple):
    """All load positions of a sector, (position,). Forces are per metre of width in 2D."""

    azimuths: FloatArray
    """Of the ground [rad]."""
    strain_energy: FloatArray
    """[J/m, or J in 3D]"""
    peak_von_mises: FloatArray
    """[Pa]"""
    peak_strain: FloatArray
    """Absolute value of a principal strain."""
    travel: FloatArray
    """Of the rim towards the ground [m]."""
    radial_force: FloatArray
    """Of the ground on the tread [N/m, or N in 3D]."""
    peak_pressure: FloatArray
    """[Pa]"""
    patch_length: FloatArray
    """[m]"""
    friction_force: FloatArray
    """[N/m, or N in 3D], towards larger azimuth."""
    wind_up: FloatArray
    """The angle by which the rim turns [rad]."""
    descent: FloatArray
    """Of the axle [m]."""
    travel_at_load: Optional[FloatArray]
    """By how far the axle descends under the load [m]; its variation is the run-out. None: not solved."""
    force_at_travel: Optional[FloatArray]
    """Radial force at a fixed travel [N/m, or N in 3D]. None: not solved."""

    @property
    def run_out(self) -> float:
        """Of the axle's height at the load, peak to peak [m]."""
        return float("nan") if self.travel_at_load is None else float(np.ptp(self.travel_at_load))


def analyze(state: State) -> RollingAnalysis:
    """How a solved wheel rolls."""
    values = of(state._core.dimension).analysis(state._core)
    return RollingAnalysis(**values)


def export(
    case: Case,
    shape: Shape,
    file: str | PathLike[str],
    tolerance: float | None = None,
    layer: str | None = None,
) -> None:
    """Writes a shape for CAD and the workshop, in millimetres, in the format of the file's ending.

    dxf, svg, stl, 3mf, step, vtu or png; for a wheel whose shape changes along the axle those that hold surfaces.
    docs/export.md describes them.

    Args:
        tolerance: the distance of the curves, in 3D of the triangles, from the shape's edges [m]; by default
            0.01 mm, in 3D 0.1 mm.
        layer: the name of the only layer to write; by default the whole wheel is written.
    """
    path = Path(file)
    content = of(case.dimension).file(shape._core, case._core, path.suffix.lstrip("."), tolerance, layer)
    path.write_bytes(content)


def report(
    folders: Iterable[str | PathLike[str]], file: str | PathLike[str], functionals: Iterable[OwnFunctional] = ()
) -> None:
    """Writes the page of one or several runs, side by side, as ``wheelwright report`` does.

    Args:
        folders: of the runs.
        file: an HTML file.
        functionals: the own quantities that their cases name.
    """
    own = tuple(functionals)
    runs = []
    for folder in folders:
        case = Case(folder, own)
        runs.append(of(case.dimension).page_run(case._core, fspath(folder)))
    Path(file).write_text(_core.report_page(runs), encoding="utf-8")
