"""Shape optimization of elastic wheels that roll.

A :class:`Case` describes a wheel, its loads and what is optimized. A :class:`Study` of it solves and evaluates
shapes with their gradients, an :class:`Optimizer` improves them, and a :class:`Run` does so in a folder with
all files of the program. Own criteria derive from :class:`Functional`, :class:`TotalFunctional`,
:class:`MaterialDensity` or :class:`EdgeDensity`. docs/python.md is the tutorial.

Units are SI and angles in radians, but for the keys of cases, which have those of the case file. In 2D forces,
energies and masses are those of one metre of width. Nothing here prints.
"""

import os as _os

from ._environment import fastest_kernels as _fastest_kernels

if "OPENBLAS_CORETYPE" not in _os.environ and (_kernels := _fastest_kernels()):
    _os.environ["OPENBLAS_CORETYPE"] = _kernels

from . import _core
from ._pieces import DesignProgress
from .case import Case, presets
from .designs import explore, sweep
from .errors import (
    CaseError,
    ComputationError,
    Error,
    FormatError,
    OutputError,
    Problem,
    RunError,
    UnknownKeyError,
)
from .functionals import (
    ByPosition,
    EdgeDensity,
    Functional,
    MaterialDensity,
    OverPositions,
    OwnFunctional,
    TotalFunctional,
)
from .optimizer import Evolver, Optimizer, Progress, Trial
from .results import RollingAnalysis, analyze, export, report
from .run import Finding, Run, RunResult
from .settings import Settings, limit_threads, settings
from .shape import Shape
from .state import Cell, Contact, Material, ObservationRows, RimForce, RimMotion, State
from .study import AccurateNumber, Evaluation, FunctionValue, Gradient, GradientCheck, Study, TaylorTest

_core.keep_freed_memory()
__version__ = _core.version()

__all__ = [
    "AccurateNumber",
    "ByPosition",
    "Case",
    "CaseError",
    "Cell",
    "ComputationError",
    "Contact",
    "DesignProgress",
    "EdgeDensity",
    "Error",
    "Evaluation",
    "Evolver",
    "Finding",
    "FormatError",
    "FunctionValue",
    "Functional",
    "Gradient",
    "GradientCheck",
    "Material",
    "MaterialDensity",
    "ObservationRows",
    "Optimizer",
    "OutputError",
    "OverPositions",
    "OwnFunctional",
    "Problem",
    "Progress",
    "RimForce",
    "RimMotion",
    "RollingAnalysis",
    "Run",
    "RunError",
    "RunResult",
    "Settings",
    "Shape",
    "State",
    "Study",
    "TaylorTest",
    "TotalFunctional",
    "Trial",
    "UnknownKeyError",
    "analyze",
    "explore",
    "export",
    "limit_threads",
    "presets",
    "report",
    "settings",
    "sweep",
]
