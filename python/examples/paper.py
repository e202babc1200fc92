"""The paper in twenty lines: strain energy over the shapes (Fig. 11), contact pressures with J_e + 6 J_p1 (Fig. 17).

usage: paper.py [SHAPES] [FOLDER]; with matplotlib
"""

import sys

import matplotlib.pyplot as plt

import wheelwright as ww

shapes = int(sys.argv[1]) if len(sys.argv) > 1 else 100
folder = sys.argv[2] if len(sys.argv) > 2 else "."

keys = {"optimizer.method": "descent", "optimizer.iterations": shapes, "grid.dilatation": "pointwise"}
energy_alone = ww.Case.preset("paper16").replace(keys)
fine_tread = {"grid.tread_levels": 2, "optimizer.tread_band": "15 mm", "objective.annulus": "10 mm"}
even = energy_alone.replace(fine_tread).minimize({"uniformity_annulus": 6})

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4), layout="constrained")
energies = [progress.objective for progress in ww.Optimizer(ww.Study(energy_alone))]
left.plot(energies)
left.set(xlabel="shape", ylabel="J_e [J/m]", title="Fig. 11: strain energy alone")

study = ww.Study(even)
*_, last = ww.Optimizer(study)
for place, pressure in study.solve(last.shape).pressure_curves():
    right.plot(1e3 * place, 1e-6 * pressure, linewidth=0.8)
right.set(xlabel="along the ground [mm]", ylabel="pressure [MPa]", title="Fig. 17: J_e + 6 J_p1, all positions")
figure.savefig(f"{folder}/paper.svg")
print(f"J_e falls from {energies[0]:.2f} to {energies[-1]:.2f} J/m")
