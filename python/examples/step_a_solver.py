"""Makes a solve step by step, and plots how the light grows. Usage: step_a_solver.py [PLOT.png]"""

import sys

import matplotlib.pyplot as plt
import penumbra

solver = penumbra.Solver(penumbra.Scene.read("floating-cube"), error=0.05)
names, flux, links = [], [], []
while step := solver.step():
    counts = solver.report["counts"]
    print(f"{step:10} {counts['elements']:6} elements {counts['links']:6} links {solver.flux[1]:10.4f} W")
    names.append(f"{len(names)} {step}")
    flux.append(solver.flux[1])
    links.append(counts["links"])
solution = solver.finish()
print(f"{len(solution.mesh)} triangles")

figure, (above, below) = plt.subplots(2, sharex=True)
above.plot(names, flux, "o-")
above.set_ylabel("received, green [W]")
below.plot(names, links, "o-")
below.set_ylabel("links")
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "steps.png")
