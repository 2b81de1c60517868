"""Scenes from arrays and files."""

import math
import warnings

import numpy as np
import pytest

import penumbra


def test_a_furnace_has_the_irradiance_of_its_closed_form(box):
    # In a closed room that emits M and reflects rho everywhere, irradiance is M / (1 - rho) everywhere.
    vertices, faces = box
    scene = penumbra.Scene(vertices, faces, reflectance=0.5, emittance=(1, 2, 3))
    exact, interpolated = penumbra.solve(scene, error=0.01).irradiance([[1, 1, 0], [2, 2, 1.3]], [[0, 0, 1], [1, 2, 3]])
    assert np.allclose(exact, [[2, 4, 6]] * 2, rtol=1e-4)  # a hundredth of the error asked for
    assert np.allclose(interpolated[0], [2, 4, 6], rtol=1e-3)
    assert np.isnan(interpolated[1]).all()  # in space, there is no face


def test_a_square_lights_as_its_closed_form():
    # A square of side 2a at height h, above its centre: E = 4 M / pi * X / sqrt(1 + X^2) * atan(X / sqrt(1 + X^2)) with
    # X = a / h, from the form factor of a rectangle in a corner, four times.
    a, h, emittance = 0.5, 1.25, 7.0
    scene = penumbra.Scene([[-a, -a, h], [-a, a, h], [a, a, h], [a, -a, h]], [[0, 1, 2, 3]], reflectance=0,
                           emittance=emittance, name="lamp")
    exact, _ = penumbra.solve(scene).irradiance([0, 0, 0], [0, 0, 1])
    x = a / h
    root = math.sqrt(1 + x * x)
    expected = 4 * emittance / (2 * math.pi) * 2 * (x / root * math.atan(x / root))
    assert exact[0, 0] == pytest.approx(expected, rel=1e-12)


def test_arrays_solve_as_the_file_that_is_saved_of_them(box, program, tmp_path):
    vertices, faces = box
    turn = np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])  # coordinates with many digits
    scene = penumbra.Scene(vertices @ turn.T, faces, reflectance=[[0.5, 0.6, 0.7]] * 5 + [[0.1] * 3],
                           emittance=[[0.0]] * 5 + [[10.0]], objects=["walls"] * 5 + ["lamp"])
    scene.save(tmp_path / "box.obj")
    points, normals = (vertices[:4] * [0.5, 0.5, 0] + [0.3, 0.2, 0.7]) @ turn.T, np.eye(4)[:, :3] + [0, 0, 0.5]
    exact, interpolated = penumbra.solve(scene, error=0.1).irradiance(points, normals)
    _, told_exact, told_interpolated = program.probe(points, normals, tmp_path / "box.obj", "--error", 0.1)
    assert np.array_equal(exact, told_exact)
    assert np.array_equal(interpolated, told_interpolated, equal_nan=True)


def test_a_scene_tells_what_it_holds(box):
    vertices, faces = box
    scene = penumbra.Scene(vertices, faces, reflectance=0.25, emittance=[[0]] * 5 + [[2]],
                           objects=["room"] * 5 + ["ceiling"], name="a room")
    assert scene.name == "a room"
    assert scene.area == pytest.approx(2 * (4 * 3 + 4 * 2.5 + 3 * 2.5))
    assert np.array_equal(scene.bounds, [[0, 0, 0], [4, 3, 2.5]])
    assert np.array_equal(scene.objects["ceiling"], [5])
    assert np.array_equal(scene.faces[5], vertices[faces[5]])
    assert {tuple(m["emittance"]) for m in scene.materials.values()} == {(0, 0, 0), (2, 2, 2)}
    assert scene.warnings == []


def test_faces_may_have_different_numbers_of_corners_and_integers_of_any_kind(box):
    vertices, faces = box
    mixed = [np.array(face, dtype=np.uint8) for face in faces[:4]] + [[1, 5, 7], (1, 7, 3), faces[5]]
    assert penumbra.Scene(vertices, mixed, emittance=1).area == pytest.approx(59)
    assert penumbra.Scene(vertices.astype(np.float32), np.array(faces), emittance=1).area == pytest.approx(59)


def test_materials_of_a_file_may_be_changed():
    # Light is linear in emittance: twice the emittance gives twice the irradiance.
    point, normal = [0.5, 0.5, 0], [0, 0, 1]
    once = penumbra.Scene.read("floating-cube", emittance={"left_light": 10, "right_light": (0, 0, 0)})
    twice = penumbra.Scene.read("floating-cube", emittance={"left_light": (20, 20, 20), "right_light": 0})
    values = [penumbra.solve(s, error=0.1).irradiance(point, normal)[0] for s in (once, twice)]
    assert np.allclose(2 * values[0], values[1], rtol=1e-6)
    with pytest.raises(penumbra.InputError, match="no material 'lamp'"):
        penumbra.Scene.read("floating-cube", emittance={"lamp": 1})


@pytest.mark.parametrize("change, message", [
    (dict(faces=[[0, 1, 99]]), "face 0: error: there is no vertex 99; vertices have the numbers 0 to 7"),
    (dict(faces=[[0, 1, 3], [0, -1, 2]]), "face 1: error: there is no vertex -1"),
    (dict(faces=[[0, 1, 3], [0]]), "face 1: error: a face with fewer than three vertices"),
    (dict(faces=[[0, 3, 1, 2]]), "face 0: error: the face crosses itself"),
    (dict(vertices=[[0, 0, 0], [1, 0, 0], [0, math.nan, 0]], faces=[[0, 1, 2]]), "vertex 2: error: "),
    (dict(vertices=[[0, 0], [1, 0]]), "vertices has the shape"),
    (dict(reflectance=1), "face 0: error: the reflectance is 1"),
    (dict(reflectance=[[0.5, 0.5]]), "reflectance has the shape"),
    (dict(emittance=-1), "face 0: error: the emittance is -1"),
    (dict(emittance=math.inf), "face 0: error: the emittance is inf"),
    (dict(objects=["a"]), "objects has 1 names for 6 faces"),
    (dict(objects=["a", "b", "c", "d", "e", ""]), "face 5: error: the name of its object"),
])
def test_bad_arrays_are_refused_by_face(box, change, message):
    vertices, faces = box
    with pytest.raises(penumbra.InputError) as error:
        penumbra.Scene(**{"vertices": vertices, "faces": faces, **change})
    assert message in str(error.value)
    assert ".obj" not in str(error.value) and ".mtl" not in str(error.value)


def test_wrong_types_are_type_errors(box):
    vertices, faces = box
    for change in (dict(vertices="no"), dict(faces=[["a", "b", "c"]]), dict(faces=[[0.5, 1, 2]]), dict(two_sided="no")):
        with pytest.raises(TypeError):
            penumbra.Scene(**{"vertices": vertices, "faces": faces, **change})
    with pytest.raises(TypeError, match="did you mean 'two_sided'"):
        penumbra.Scene(vertices, faces, twosided=True)


def test_what_is_repaired_is_warned_about(box):
    vertices, faces = box
    with pytest.warns(penumbra.PenumbraWarning, match="face 6: warning: 1 face without area dropped"):
        scene = penumbra.Scene(vertices, faces + [[0, 1, 1]], emittance=1)
    assert len(scene.faces[6]) == 0
    with pytest.warns(penumbra.PenumbraWarning, match="nothing emits light"):
        penumbra.Scene(vertices, faces)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(penumbra.PenumbraWarning):
            penumbra.Scene(vertices, faces)
    with pytest.raises(penumbra.InputError, match="face 6: error: the face repeats a vertex"):
        penumbra.Scene(vertices, faces + [[0, 1, 1]], emittance=1, strict=True)


def test_sides_and_clamps(box):
    vertices, faces = box
    assert len(penumbra.Scene(vertices, faces, emittance=1, two_sided=True).faces) == 12
    with pytest.warns(penumbra.PenumbraWarning, match="turns its back"):
        flipped = penumbra.Scene(vertices, faces, emittance=1, flip=True)
    assert np.array_equal(flipped.faces[0], vertices[faces[0][::-1]])
    with pytest.warns(penumbra.PenumbraWarning, match="clamped"):
        clamped = penumbra.Scene(vertices, faces, reflectance=2, emittance=1, max_reflectance=0.9)
    assert {m["reflectance"] for m in clamped.materials.values()} == {(0.9, 0.9, 0.9)}


def test_bad_files_have_the_line_of_the_command_line(tmp_path):
    (tmp_path / "bad.obj").write_text("v 0 0 0\nv 1 0 x\n")
    with pytest.raises(penumbra.InputError, match="bad.obj:2: error: "):
        penumbra.Scene.read(tmp_path / "bad.obj")
    with pytest.raises(penumbra.InputError, match="no such file"):
        penumbra.Scene.read("no-such-scene")
    assert issubclass(penumbra.InputError, ValueError)
