"""Compares two ways to find form factors: how far each is from the exact one. Usage: compare_methods.py [PLOT.png]"""

import sys

import matplotlib.pyplot as plt
import numpy as np
import penumbra


def facing_squares(distance):
    """Two unit squares that face each other."""
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    vertices = np.vstack([np.column_stack([square, np.full(4, z)]) for z in (0, distance)])
    return penumbra.Scene(vertices, [[0, 1, 2, 3], [7, 6, 5, 4]], emittance=1)


distances = np.geomspace(0.2, 5, 12)
scenes = [facing_squares(distance) for distance in distances]
exact = np.array([penumbra.form_factor(scene, 0, 1)[0] for scene in scenes])
for method in ("disk", "cubature"):
    found = np.array([penumbra.form_factor(scene, 0, 1, method=method)[0] for scene in scenes])
    plt.loglog(distances, np.abs(found / exact - 1) + 1e-12, "o-", label=method)
plt.xlabel("distance of two unit squares [m]")
plt.ylabel("relative error of the form factor")
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "methods.png")
