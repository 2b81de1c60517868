"""Solving step by step."""

import numpy as np
import pytest

import penumbra
from conftest import points_on_plane


def test_steps_lead_to_the_solution(cube_solution):
    points, normals = points_on_plane(20)
    solver = penumbra.Solver(cube_solution.scene, error=0.1)
    assert solver.next == "link"
    with pytest.raises(penumbra.InputError, match="nothing is linked yet"):
        solver.flux
    names, elements = [], []
    while solver.next:
        expected = solver.next
        names.append(solver.step())
        assert names[-1] == expected
        elements.append(solver.report["counts"]["elements"])
        solver.mesh("gouraud")  # looking changes nothing
        solver.irradiance(points, normals)
    assert solver.step() is None
    assert names[0] == "link" and names[-1] == "correct" and set(names[1:-1]) == {"iterate"}
    assert elements == sorted(elements)
    solution = solver.finish()
    assert np.array_equal(solution.mesh.coefficients, cube_solution.mesh.coefficients)
    assert np.array_equal(solution.irradiance(points, normals)[0], cube_solution.irradiance(points, normals)[0])
    with pytest.raises(penumbra.InputError, match="finished"):
        solver.step()


def test_finish_makes_the_steps_that_are_left(cube_solution):
    solver = penumbra.Solver(cube_solution.scene, error=0.1)
    solver.step()
    assert np.array_equal(solver.finish().mesh.coefficients, cube_solution.mesh.coefficients)


def test_light_in_a_furnace_grows_to_its_closed_form(box):
    vertices, faces = box
    solver = penumbra.Solver(penumbra.Scene(vertices, faces, reflectance=0.5, emittance=1), error=0.01)
    fluxes = []
    while solver.step():
        fluxes.append(solver.flux[0])
    assert fluxes[0] == 0 and fluxes[-1] == pytest.approx(59 * 2, rel=1e-3)  # 59 m^2, M / (1 - rho)
    assert solver.irradiance([1, 1, 0], [0, 0, 1])[0, 0] == pytest.approx(2, rel=1e-3)


def test_a_mesh_of_a_step_outlives_it(cube_solution):
    solver = penumbra.Solver(cube_solution.scene, error=0.1)
    solver.step()
    solver.step()
    mesh = solver.mesh("flat")
    before = mesh.coefficients.copy()
    solver.step()
    solver.finish()
    assert np.array_equal(mesh.coefficients, before)
    with pytest.raises(penumbra.InputError, match="finished"):
        solver.mesh()
    with pytest.raises(penumbra.InputError, match="no mesh 'round'"):
        penumbra.Solver(cube_solution.scene).mesh("round")
