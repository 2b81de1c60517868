"""Solutions: the numbers are those of the command line, to the bit."""

import os

import numpy as np
import pytest

import penumbra
from conftest import points_on_plane


def test_irradiance_is_that_of_the_command_line(program):
    points, normals = points_on_plane(40)
    scene = penumbra.Scene.read("floating-cube")
    for options, arguments in ((dict(error=0.1), ["--error", "0.1"]),
                               (dict(error=0.2, corrections=1, max_leaf_dsets=4, seed=3, refine="transport"),
                                ["--error", "0.2", "--corrections", "1", "--max-leaf-dsets", "4", "--seed", "3",
                                 "--refine", "transport"])):
        told = penumbra.solve(scene, **options).probe(points, normals)
        patch, exact, interpolated = program.probe(points, normals, "floating-cube", *arguments)
        assert np.array_equal(told["patch"], patch)
        assert np.array_equal(told["exact"], exact)
        assert np.array_equal(told["interpolated"], interpolated, equal_nan=True)
        assert np.isfinite(interpolated[:20]).all() and (patch[:20] == 0).all()


def test_the_number_of_threads_changes_no_bit(cube_solution):
    points, normals = points_on_plane(30)
    before = penumbra.threads()
    try:
        penumbra.set_threads(1)
        alone = penumbra.solve(cube_solution.scene, error=0.1)
        assert np.array_equal(alone.mesh.coefficients, cube_solution.mesh.coefficients)
        assert np.array_equal(alone.irradiance(points, normals)[0], cube_solution.irradiance(points, normals)[0])
    finally:
        penumbra.set_threads(0)
    assert penumbra.threads() == before


def test_exact_methods_agree_and_parts_add_up(cube_solution):
    points, normals = points_on_plane(30)
    auto = cube_solution.probe(points, normals)
    for method in ("clipping", "backprojection", "vertex-tracing"):
        exact, _ = cube_solution.irradiance(points, normals, method=method)
        assert np.allclose(exact, auto["exact"], rtol=1e-9, atol=1e-9)
    assert (auto["direct"] <= auto["exact"] * (1 + 1e-12)).all()
    step = 1e-5  # the gradient is the derivative
    above, _ = cube_solution.irradiance(points[20:] + [step, 0, 0], normals[20:])
    below, _ = cube_solution.irradiance(points[20:] - [step, 0, 0], normals[20:])
    assert np.allclose((above - below) / (2 * step), auto["gradient"][20:, :, 0], rtol=1e-3, atol=1e-4)


def test_one_point_and_one_normal_for_all(cube_solution):
    one, _ = cube_solution.irradiance([0.5, 0.5, 0], [0, 0, 2])
    many, _ = cube_solution.irradiance([[0.5, 0.5, 0], [1, 1, 0]], [0, 0, 1])
    assert one.shape == (1, 3) and many.shape == (2, 3) and np.array_equal(one[0], many[0])
    none, _ = cube_solution.irradiance(np.zeros((0, 3)), np.zeros((0, 3)))
    assert none.shape == (0, 3)


def test_points_that_cannot_be_are_refused(cube_solution):
    for points, normals, message in (([[0, 0]], [[0, 0, 1]], "points has the shape"),
                                     ([[0, 0, 0]] * 3, [[0, 0, 1]] * 2, "3 points and 2 normals"),
                                     ([[0, 0, np.nan]], [[0, 0, 1]], "point 0: a coordinate is infinite or nan")):
        with pytest.raises(penumbra.InputError, match=message):
            cube_solution.irradiance(points, normals)
    with pytest.raises(penumbra.InputError, match="no method 'guess'"):
        cube_solution.irradiance([0, 0, 1], [0, 0, 1], method="guess")
    with pytest.warns(penumbra.PenumbraWarning, match="far outside"):
        cube_solution.irradiance([1e5, 0, 1], [0, 0, 1])


def test_files_are_those_of_the_command_line(program, tmp_path):
    points, normals = points_on_plane(10)
    solution = penumbra.solve(penumbra.Scene.read("floating-cube"), error=0.1, measure=True)
    solution.save(tmp_path / "ours.sol")
    program.run("solve", "floating-cube", "--error", "0.1", "-o", tmp_path / "theirs.sol")
    assert (tmp_path / "ours.sol").read_bytes() == (tmp_path / "theirs.sol").read_bytes()
    loaded = penumbra.Solution.load(tmp_path / "theirs.sol")
    assert np.array_equal(loaded.irradiance(points, normals)[0], solution.irradiance(points, normals)[0])
    assert np.array_equal(loaded.mesh.coefficients, solution.mesh.coefficients)
    loaded.save(tmp_path / "again.sol")
    assert (tmp_path / "again.sol").read_bytes() == (tmp_path / "ours.sol").read_bytes()
    _, exact, _ = program.probe(points, normals, tmp_path / "ours.sol")
    assert np.array_equal(exact, solution.irradiance(points, normals)[0])


def test_saving_measures_and_bad_files_are_refused(cube_solution, tmp_path):
    solution = penumbra.solve(cube_solution.scene, error=0.1)
    solution.save(tmp_path / "later.sol")
    assert solution.report["error"]["met"]
    assert penumbra.Solution.load(tmp_path / "later.sol").report["error"] == solution.report["error"]
    with pytest.raises(penumbra.InputError, match="cannot write"):
        solution.save(tmp_path / "no" / "folder.sol")
    (tmp_path / "later.sol").write_bytes(b"v 0 0 0\n")
    with pytest.raises(penumbra.InputError, match="no solution"):
        penumbra.Solution.load(tmp_path / "later.sol")
    assert sorted(os.listdir(tmp_path)) == ["later.sol"]


def test_energy_balances_and_the_report_tells_it(box):
    vertices, faces = box
    scene = penumbra.Scene(vertices, faces, reflectance=0.5, emittance=[[0]] * 5 + [[10]])
    solution = penumbra.solve(scene, error=0.1)
    assert solution.options["error"] == 0.1 and solution.options["solver"] == "hierarchical"
    report = solution.measure()
    assert report["energy"]["emitted"] == pytest.approx(3 * 4 * 3 * 10)
    assert abs(report["energy"]["relative_imbalance"]) < 0.02 and report["energy"]["escaped"] == 0
    assert report["error"]["met"]
    assert report["counts"]["triangles"] == len(solution.mesh)


def test_export_writes_what_others_read(cube_solution, tmp_path):
    cube_solution.export(tmp_path / "cube.ply")
    assert (tmp_path / "cube.ply").read_bytes().startswith(b"ply")
    with pytest.raises(penumbra.InputError, match="use Scene.save"):
        cube_solution.export(tmp_path / "cube.obj")
    with pytest.raises(penumbra.InputError):
        cube_solution.export(tmp_path / "cube.doc")
    with pytest.raises(penumbra.InputError, match="files that end in .obj"):
        cube_solution.scene.save(tmp_path / "cube.ply2")
