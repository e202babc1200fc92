"""Pictures: the outline, the deformed wheel coloured by its von Mises stress, and the pressures.

usage: pictures.py [FOLDER]; with matplotlib
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import wheelwright as ww

folder = sys.argv[1] if len(sys.argv) > 1 else "."
magnified = 20

study = ww.Study(ww.Case.preset("curved-spokes"))
state = study.solve()
figure, (outline, deformed, pressures) = plt.subplots(1, 3, figsize=(15, 5), layout="constrained")

for line in study.shape.contours():
    outline.fill(*line.T, fill=False)
outline.set(aspect="equal", title="outline")



def around(field):
    """The field of all sectors, one after the other, (azimuth, radial, component)."""
    return field.reshape(-1, *field.shape[2:])


u, stress = around(state.displacement(0)), around(state.von_mises(0)) * 1e-6
n_azimuths, n_radii = stress.shape
azimuth = 2 * np.pi * np.arange(n_azimuths)[:, None] / n_azimuths
radius = np.linspace(*study.shape.radii, n_radii)
x = radius * np.cos(azimuth) + magnified * u[..., 0]
y = radius * np.sin(azimuth) + magnified * u[..., 1]

# Two triangles between four nodes; those with nodes in the holes are left out.
node = np.arange(n_azimuths * n_radii).reshape(n_azimuths, n_radii)
turned = np.roll(node, -1, axis=0)
corners = node[:, :-1], turned[:, :-1], turned[:, 1:], node[:, 1:]
triangles = np.concatenate([np.stack([corners[0], corners[k], corners[k + 1]], -1).reshape(-1, 3) for k in (1, 2)])
has_material = np.isfinite(x + y + stress).ravel()
triangles = triangles[has_material[triangles].all(axis=1)]
x, y, stress = (np.where(has_material, field.ravel(), 0) for field in (x, y, stress))
picture = deformed.tripcolor(x, y, triangles, stress, shading="gouraud")
figure.colorbar(picture, ax=deformed, label="von Mises stress [MPa]")
deformed.set(aspect="equal", title=f"deformation x {magnified}")

for place, pressure in state.pressure_curves():
    pressures.plot(1e3 * place, 1e-6 * pressure)
pressures.set(xlabel="along the ground [mm]", ylabel="pressure [MPa]", title="contact")
figure.savefig(f"{folder}/pictures.png")
print(f"peak pressure {1e-6 * max(c.pressure.max() for c in state.contacts):.2f} MPa")
