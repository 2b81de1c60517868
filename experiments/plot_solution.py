#!/usr/bin/python3
"""Reads a solution file with h5py and plots the irradiance of a patch: an example to begin from.

    plot_solution.py SOLUTION.h5 PICTURE.png [PATCH]

PATCH is a row of scene/patches, by default the one that receives most light. thesis_notes/solution_file.md tells
what lies where.
"""

import sys

import h5py
import matplotlib
import numpy

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

CHANNEL = 1  # green
PARTS = 8  # a triangle is drawn as PARTS x PARTS flat ones


def quadratic(coefficients, s, t):
    """a s^2 + 2b st + 2c s + d t^2 + 2e t + f, for coefficients of n triangles at m places: n x m."""
    a, b2, c2, d, e2, f = (coefficients[:, k, CHANNEL, None] for k in range(6))
    return a * s**2 + b2 * s * t + c2 * s + d * t**2 + e2 * t + f


def places(parts):
    """Barycentric coordinates of a triangle's lattice, and the small triangles between them."""
    number = {}
    for row in range(parts + 1):
        for column in range(parts + 1 - row):
            number[column, row] = len(number)
    small = []
    for column, row in number:
        if column + row < parts:
            small.append([number[column, row], number[column + 1, row], number[column, row + 1]])
        if column + row < parts - 1:
            small.append([number[column + 1, row], number[column + 1, row + 1], number[column, row + 1]])
    s, t = numpy.array(list(number)).T / parts
    return s, t, numpy.array(small)


def main():
    path, picture = sys.argv[1:3]
    with h5py.File(path, "r") as file:
        positions = file["mesh/positions"][:]
        table = file["mesh/triangles"]
        triangles, patch = table["vertices"][:], table["patch"][:]
        edges, coefficients = table["discontinuity"][:], table["interpolant"][:]
        corners = file["scene/patches/vertices"][:]

    # Power arriving on each triangle: of a quadratic the three middles of edges give the exact mean.
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    area = 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    mean = quadratic(coefficients, numpy.array([0.5, 0.5, 0]), numpy.array([0, 0.5, 0.5])).mean(axis=1)
    power = numpy.bincount(patch, area * mean, len(corners))
    shown = int(sys.argv[3]) if len(sys.argv) > 3 else int(power.argmax())
    print(f"{len(triangles)} triangles on {len(corners)} patches receive {power.sum():.6g} W in channel {CHANNEL}; "
          f"patch {shown}: {power[shown]:.6g} W")

    # The patch in its own plane: x along its first edge.
    x_axis = corners[shown, 1] - corners[shown, 0]
    x_axis /= numpy.linalg.norm(x_axis)
    normal = numpy.cross(x_axis, corners[shown, 2] - corners[shown, 0])
    y_axis = numpy.cross(normal / numpy.linalg.norm(normal), x_axis)
    flat = (positions - corners[shown, 0]) @ numpy.array([x_axis, y_axis]).T

    own = numpy.flatnonzero(patch == shown)
    s, t, small = places(PARTS)
    corner = flat[triangles[own]]
    at = (corner[:, None, 0] + s[:, None] * (corner[:, None, 1] - corner[:, None, 0]) +
          t[:, None] * (corner[:, None, 2] - corner[:, None, 0]))
    value = quadratic(coefficients[own], s, t)
    facets = (small[None] + len(s) * numpy.arange(len(own))[:, None, None]).reshape(-1, 3)

    figure, axes = plt.subplots(figsize=(7, 6), layout="constrained")
    drawn = axes.tripcolor(at[..., 0].ravel(), at[..., 1].ravel(), facets, value.ravel(), shading="gouraud",
                           cmap="inferno")
    for k in range(3):
        for line, style in ((edges[own, k] == 0, dict(color="white", linewidth=0.15, alpha=0.5)),
                            (edges[own, k] != 0, dict(color="cyan", linewidth=0.6))):
            ends = corner[line][:, [k, (k + 1) % 3]]
            axes.plot(ends[..., 0].T, ends[..., 1].T, **style)
    axes.set(aspect="equal", xlabel="m", ylabel="m", title=f"Patch {shown}: irradiance; discontinuities in cyan")
    figure.colorbar(drawn, label="W/m²")
    figure.savefig(picture, dpi=150)


main()
