"""From arrays to a plot of irradiance along a line on the floor. Usage: irradiance_along_a_line.py [PLOT.png]"""

import sys

import matplotlib.pyplot as plt
import numpy as np
import penumbra

# A floor of 4 m x 4 m, a lamp of 1 m x 1 m that shines down from 2 m, and a board that hides a part of it.
vertices = [[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0], [-.5, -.5, 2], [-.5, .5, 2], [.5, .5, 2], [.5, -.5, 2],
            [0, -1, 1], [1, -1, 1], [1, 1, 1], [0, 1, 1]]
faces = [[0, 1, 2, 3], [4, 5, 6, 7], [11, 10, 9, 8]]  # the front of the board looks down, too
scene = penumbra.Scene(vertices, faces, reflectance=0.5, emittance=[[0], [100], [0]])
solution = penumbra.solve(scene, error=0.02)
x = np.linspace(-2, 2, 401)
exact, interpolated = solution.irradiance(np.column_stack([x, 0 * x, 0 * x]), [0, 0, 1])
plt.plot(x, exact[:, 1], label="exact")
plt.plot(x, interpolated[:, 1], "--", label="interpolated")
plt.xlabel("x [m]")
plt.ylabel("irradiance, green [W/m²]")
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "irradiance.png")
