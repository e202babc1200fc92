"""Contact laws compared on one shape: strain energy, travel and friction by the law.

usage: contact_laws.py
"""

import numpy as np

import wheelwright as ww

wheel = ww.Case.preset("paper16")
laws = {
    "Nitsche": {},
    "Nitsche, gamma_0 = 10": {"contact.gamma_0": 10},
    "penalty": {"contact.method": "penalty"},
    "penalty, gamma_0 = 10": {"contact.method": "penalty", "contact.gamma_0": 10},
    "Nitsche, friction 0.3": {"contact.friction": 0.3},
}
for name, keys in laws.items():
    state = ww.Study(wheel.replace(keys)).solve()
    analysis = ww.analyze(state)
    friction = max(np.abs(c.traction[:, 1]).max() for c in state.contacts)
    print(
        f"{name:24} J_e {state.strain_energy.sum():8.4f} J/m, travel {1e3 * analysis.travel.mean():.5f} mm, "
        f"peak pressure {1e-6 * analysis.peak_pressure.max():.3f} MPa, largest friction {1e-6 * friction:.3f} MPa"
    )
