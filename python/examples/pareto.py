"""The front between strain energy and evenness of the contact pressure: one optimization for every weight.

usage: pareto.py [SHAPES] [FOLDER]; with matplotlib
"""

import sys

import matplotlib.pyplot as plt

import wheelwright as ww

shapes = int(sys.argv[1]) if len(sys.argv) > 1 else 30
folder = sys.argv[2] if len(sys.argv) > 2 else "."

wheel = ww.Case.preset("paper16").replace(
    {
        "grid.radial_cells": 14,
        "grid.angular_cells": 192,
        "optimizer.rim_band": "1 cm",
        "optimizer.tread_band": "2 cm",
        "optimizer.iterations": shapes,
    }
)
for weight in (1, 10, 100, 1000):
    *_, last = ww.Optimizer(ww.Study(wheel.minimize({"uniformity_dual": weight})))
    terms = last.evaluation.terms
    plt.loglog(terms["strain_energy"], terms["uniformity_dual"], "o", label=f"weight {weight}")
    print(f"weight {weight}: J_e {terms['strain_energy']:.3f}, J_p2 {terms['uniformity_dual']:.4g} J/m")
plt.xlabel("J_e [J/m]")
plt.ylabel("J_p2 [J/m]")
plt.legend()
plt.savefig(f"{folder}/pareto.svg")
