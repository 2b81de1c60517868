"""h5py opens a solution file as it is, and the example that plots it finds in it the light that `info` tells of.

    read_solution.py PENUMBRA PLOT_SOLUTION SCRATCH
"""

import pathlib
import re
import subprocess
import sys

import h5py
import numpy

program, example, scratch = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
scratch.mkdir(parents=True, exist_ok=True)


def run(*arguments):
    return subprocess.run(arguments, cwd=scratch, check=True, capture_output=True, text=True).stdout


def demand(condition, what):
    if not condition:
        sys.exit("failed: " + what)


run(program, "solve", "floating-cube", "--error", "0.1", "-o", "a.h5")
told = run(sys.executable, example, "a.h5", "a.png")
demand((scratch / "a.png").read_bytes().startswith(b"\x89PNG"), "a picture is written")
triangles, power = re.search(r"(\d+) triangles .* receive (\S+) W", told).groups()

# What the solution's leaves receive, from other tables of the same file: both are the same light.
with h5py.File(scratch / "a.h5", "r") as file:
    demand(len(file["mesh/triangles/vertices"]) == int(triangles), "the number of triangles")
    corners = file["scene/patches/vertices"][:]  # the fourth repeats the third of a triangle
    area = 0.5 * numpy.linalg.norm(numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1)
    received = (area * file["elements/irradiance"][: len(area), 1]).sum()
TOLERANCE = 0.02  # a fifth of the error asked for: a mean errs less than points do
demand(abs(received / float(power) - 1) < TOLERANCE, f"power {power} W of triangles, {received} W of patches")
