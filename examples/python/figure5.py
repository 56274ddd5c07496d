"""The paper's figure 5: omega_z of a free box, as an ANCF body and conventional.

    python3 examples/python/figure5.py [FILE.svg]
"""
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

import emmy


def omega_z(**formulation):
    box = {"name": "box", "box": {"size": [3, 2, 1], "density": 2700},
           "angular_velocity": [0.3, 0.5, 0.8], **formulation}
    history = emmy.Simulation({
        "format": "emmy-case/1", "name": "figure 5", "rigid_bodies": [box],
        "integrator": {"method": "energy_momentum", "time_step": 1e-3,
                       "duration": 10}}).run(every=10)
    return history["time"], history["box.omega_polar_z"]


for penalty in (1e4, 1e5, 1e6, 1e8):
    plt.plot(*omega_z(penalty=penalty), label=f"ANCF, {penalty:.0e} Pa")
plt.plot(*omega_z(formulation="conventional"), "k--", label="conventional")
plt.xlabel("time [s]")
plt.ylabel("angular velocity about z [rad/s]")
plt.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=3, frameon=False)
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "figure5.svg")
