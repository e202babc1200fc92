"""A wheel in 3D: the same names, with the width.

usage: solid.py [CELLS] [SHAPES]
"""

import sys

import numpy as np

import wheelwright as ww

cells = int(sys.argv[1]) if len(sys.argv) > 1 else 4
shapes = int(sys.argv[2]) if len(sys.argv) > 2 else 3

case = ww.Case.preset("paper16-3d").replace(
    {
        "grid.radial_cells": 8,
        "grid.angular_cells": 96,
        "grid.axial_cells": cells,
        "optimizer.rim_band": "18 mm",
        "optimizer.tread_band": "35 mm",
        "holes.ring[1].radius": "30 mm",
        "optimizer.iterations": shapes,
    }
)
study = ww.Study(case)
print(f"{study.shape!r}, {study.shape.nodes.shape[-1]} coordinates")
for progress in ww.Optimizer(study):
    print(progress)

state = study.solve(progress.shape)
contact = state.contacts[0]
along_axle = contact.place[:, 2].round(6)
for z in np.unique(along_axle):
    peak = contact.pressure[along_axle == z].max()
    print(f"{1e3 * z:6.1f} mm along the axle: peak pressure {1e-6 * peak:.3f} MPa")
