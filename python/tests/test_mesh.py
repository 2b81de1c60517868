"""Meshes as arrays."""

import gc

import numpy as np
import pytest

import penumbra
from conftest import box_arrays


def value_at(mesh, triangle, s, t):
    a, b, c, d, e, f = mesh.coefficients[triangle]
    return np.maximum(0, a * s * s + b * s * t + c * s + d * t * t + e * t + f)


def test_coefficients_give_the_interpolated_irradiance(cube_solution):
    mesh = cube_solution.mesh
    triangles = np.flatnonzero(mesh.patch == 0)[:40]
    corners = mesh.vertices[mesh.triangles[triangles]]
    s, t = 0.3, 0.45
    points = corners[:, 0] + s * (corners[:, 1] - corners[:, 0]) + t * (corners[:, 2] - corners[:, 0])
    _, interpolated = cube_solution.irradiance(points, [0, 0, 1])
    expected = np.array([value_at(mesh, triangle, s, t) for triangle in triangles])
    assert np.allclose(interpolated, expected, rtol=1e-6, atol=1e-9)


def test_triangles_tile_the_faces(cube_solution):
    mesh, scene = cube_solution.mesh, cube_solution.scene
    corners = mesh.vertices[mesh.triangles]
    crosses = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(crosses, axis=1) / 2
    assert areas.sum() == pytest.approx(scene.area, rel=1e-9)
    for face, vertices in enumerate(scene.faces):
        normal = np.cross(vertices[1] - vertices[0], vertices[2] - vertices[0])
        of_face = mesh.patch == face
        assert areas[of_face].sum() == pytest.approx(np.linalg.norm(normal), rel=1e-9)  # all are parallelograms
        assert (crosses[of_face] @ normal > 0).all()  # counter-clockwise from the front
    assert mesh.discontinuity.any() and not mesh.discontinuity.all()


def test_materials_are_those_of_the_faces(cube_solution):
    mesh, scene = cube_solution.mesh, cube_solution.scene
    lamp = scene.objects["left_light"][0]
    assert np.array_equal(mesh.emittance[mesh.patch == lamp][0], scene.materials["left_light"]["emittance"])
    assert np.array_equal(mesh.reflectance[mesh.patch == 0][0], scene.materials["plane"]["reflectance"])


def test_arrays_show_memory_and_keep_it_alive():
    vertices, faces = box_arrays()
    solution = penumbra.solve(penumbra.Scene(vertices, faces, emittance=1), error=0.5)
    mesh = solution.mesh
    for name in ("vertices", "triangles", "coefficients", "discontinuity"):
        array = getattr(mesh, name)
        assert not array.flags.owndata and not array.flags.writeable
        assert array.__array_interface__["data"] == getattr(solution.mesh, name).__array_interface__["data"]
        with pytest.raises(ValueError):
            array[0] = 0
    coefficients, copy = mesh.coefficients, mesh.coefficients.copy()
    del solution, mesh
    gc.collect()
    [penumbra.solve(penumbra.Scene(vertices, faces, emittance=1), error=0.5) for _ in range(3)]
    assert np.array_equal(coefficients, copy)
