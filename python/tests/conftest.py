"""What the tests share. The package and the program are those of PYTHONPATH and PENUMBRA_PROGRAM; without these, those of
the newest build in the checkout."""

import csv
import glob
import os
import subprocess
import sys

import numpy as np
import pytest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def _newest(pattern):
    return max(glob.glob(os.path.join(ROOT, "build", pattern)), key=os.path.getmtime, default=None)


try:
    import penumbra
except ImportError:
    _module = _newest("*/python/penumbra/core*.so")
    if not _module:
        pytest.exit("the package is not built: cmake --preset dev && cmake --build --preset dev", 2)
    sys.path.insert(0, os.path.dirname(os.path.dirname(_module)))
    import penumbra

PROGRAM = os.environ.get("PENUMBRA_PROGRAM") or _newest("*/bin/penumbra")


class Program:
    """The command line, in a folder of its own."""

    def __init__(self, folder):
        self.folder = folder

    def run(self, *arguments):
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    def probe(self, points, normals, *arguments):
        """The columns of `probe`: patch (n,), exact (n, 3) and interpolated (n, 3)."""
        path = os.path.join(self.folder, "points.csv")
        with open(path, "w", encoding="utf-8") as file:
            file.write("x,y,z,nx,ny,nz\n")
            for row in np.hstack([points, normals]):
                file.write(",".join(repr(float(value)) for value in row) + "\n")
        rows = list(csv.DictReader(self.run("probe", *arguments, "--points", path).splitlines()))

        def columns(name):
            return np.array([[float(row[f"{name}_{channel}"]) for channel in "rgb"] for row in rows])
        return np.array([int(row["patch"]) for row in rows]), columns("exact"), columns("interp")


@pytest.fixture
def program(tmp_path):
    if not PROGRAM:
        pytest.skip("the program is not built")
    return Program(str(tmp_path))


def box_arrays(size=(4.0, 3.0, 2.5)):
    """The inside of a box: vertices, and six faces whose fronts look inwards; the last is the ceiling."""
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]) * np.array(size)
    faces = [[0, 1, 3, 2], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3], [4, 6, 7, 5]]
    return corners, faces


@pytest.fixture
def box():
    return box_arrays()


@pytest.fixture(scope="session")
def cube_solution():
    """The scene floating-cube, solved roughly."""
    return penumbra.solve(penumbra.Scene.read("floating-cube"), error=0.1)


def points_on_plane(count, seed=1):
    """Random points on the floor of floating-cube and above it, with normals."""
    generator = np.random.default_rng(seed)
    points = np.column_stack([generator.uniform(-1.9, 1.9, (count, 2)), np.zeros(count)])
    points[count // 2:, 2] = generator.uniform(0.1, 2, count - count // 2)
    normals = np.tile([0.0, 0.0, 1.0], (count, 1))
    normals[count // 2:] = generator.normal(size=(count - count // 2, 3))
    return points, normals
