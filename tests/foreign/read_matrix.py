"""h5py, NumPy and the csv module read the matrices of `form-factor --all`, and find the same numbers in each.

    read_matrix.py PENUMBRA SCRATCH
"""

import csv
import pathlib
import subprocess
import sys

import h5py
import numpy

program, scratch = sys.argv[1], pathlib.Path(sys.argv[2])
scratch.mkdir(parents=True, exist_ok=True)


def run(*arguments):
    return subprocess.run(arguments, cwd=scratch, check=True, capture_output=True, text=True).stdout


def demand(condition, what):
    if not condition:
        sys.exit("failed: " + what)


# A closed room, and an object that is named as CSV does not like it.
SIDES = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
corners = [(x, y, z) for z in (0, 1) for y in (0, 2) for x in (0, 3)]
text = "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + 'o floor, "oak"\nf 1 2 4 3\no rest\n'
text += "".join("f " + " ".join(map(str, side)) + "\n" for side in SIDES[1:])
(scratch / "room.obj").write_text(text)
for by in ("face", "object"):
    for ending in ("h5", "npy", "csv", "vf"):
        run(program, "form-factor", "room.obj", "--all", "--by", by, "-o", f"{by}.{ending}")
    run(program, "form-factor", "room.obj", "--all", "--by", by, "-o", "again.h5", "--threads", "1")
    demand((scratch / "again.h5").read_bytes() == (scratch / f"{by}.h5").read_bytes(), "the same bytes")
    dense = numpy.load(scratch / f"{by}.npy")
    with h5py.File(scratch / f"{by}.h5", "r") as file:
        matrix, area = file["F"][:], file["area"][:]
        names = list(file["names"].asstr()[:])
        demand(file["names"][0] == names[0].encode(), "names are texts of any length")
        demand(file["area"].attrs["units"] == "m^2" and file["F"].attrs["units"] == "1", "units are strings")
        demand(file["error"].shape == matrix.shape and (file["error"][:] >= 0).all(), "errors")
        sparse = numpy.zeros_like(matrix)
        for row in range(len(area)):
            entries = slice(*file["indptr"][row : row + 2])
            sparse[row, file["indices"][entries]] = file["data"][entries]
        demand(numpy.array_equal(file["closure"][:].round(12), matrix.sum(axis=1).round(12)), "row sums")
    demand(numpy.array_equal(dense, matrix) and numpy.array_equal(sparse, matrix), "dense and sparse are one")
    demand(abs(matrix.sum(axis=1) - 1).max() < 1e-6, f"closure {matrix.sum(axis=1)}")
    exchange = area[:, None] * matrix
    demand(abs(exchange - exchange.T).max() <= 1e-9 * exchange.max(), "reciprocity")
    # View3D's text: a line of 30 characters that ends in the number of rows, areas, the matrix, emittances.
    header, *lines = (scratch / f"{by}.vf").read_text().splitlines()
    demand(len(header) == 30 and header.split()[2:] == ["0", "0", "0", str(len(area))], f"header {header!r}")
    numbers = [numpy.array(line.split(), float) for line in lines]
    demand(numpy.array_equal(numbers[0], area) and numpy.array_equal(numbers[1:-1], matrix), "View3D's text")
    demand(numpy.array_equal(numbers[-1], numpy.full(len(area), 0.5)), "emittances of grey faces")
    with open(scratch / f"{by}.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    demand(len(rows) == numpy.count_nonzero(matrix), "a row of CSV for each factor")
    for row in rows:
        demand(float(row["F"]) == matrix[names.index(row["from"]), names.index(row["to"])], f"{row}")
    if by == "object":
        demand(names == ['floor, "oak"', "rest"], f"names {names}")
        demand(abs(area[0] - 6) < 1e-12, "the floor's area")
