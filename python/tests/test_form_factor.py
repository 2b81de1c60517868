"""Form factors."""

import math

import numpy as np
import pytest

import penumbra


def squares(distance, blocker=False):
    """Two unit squares that face each other, and perhaps one twice as wide in the middle."""
    vertices, faces = [], []
    for z, half, up in [(0, 0.5, True), (distance, 0.5, False)] + [(distance / 2, 1, True)] * blocker:
        corners = [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]]
        faces.append([len(vertices) + i for i in range(4)])
        vertices += corners if up else corners[::-1]
    return penumbra.Scene(vertices, faces, emittance=1, objects=["low", "high"] + ["between"] * blocker)


def closed_form(distance):
    x = y = 1 / distance
    a, b = math.sqrt(1 + x * x), math.sqrt(1 + y * y)
    return 2 / (math.pi * x * y) * (math.log(a * b / math.sqrt(1 + x * x + y * y)) + x * b * math.atan(x / b)
                                    + y * a * math.atan(y / a) - x * math.atan(x) - y * math.atan(y))


@pytest.mark.parametrize("distance", [0.3, 1, 4])
def test_parallel_squares(distance):
    factor, error = penumbra.form_factor(squares(distance), "low", "high")
    assert factor == pytest.approx(closed_form(distance), rel=1e-10) and error < 1e-10


@pytest.mark.filterwarnings("ignore::penumbra.PenumbraWarning")
def test_what_stands_between_hides_all():
    assert penumbra.form_factor(squares(1, blocker=True), 0, 1)[0] == 0


def test_methods_agree_within_their_errors():
    scene, expected = squares(1), closed_form(1)
    for method, tolerance in (("backprojection", 1e-9), ("clipping", 1e-9), ("cubature", 0.01), ("disk", 0.25),
                              ("monte-carlo", 0.01)):
        assert penumbra.form_factor(scene, 0, 1, method=method)[0] == pytest.approx(expected, rel=tolerance)
    factor, error = penumbra.form_factor(scene, 0, 1, method="monte-carlo", rays=100_000, seed=2)
    assert abs(factor - expected) < 4 * error


def test_it_is_that_of_the_command_line(program):
    scene = penumbra.Scene.read("floating-cube")
    for from_, to in (("plane", "cube"), ("cube", "left_light"), (0, 3)):
        ours = penumbra.form_factor(scene, from_, to)
        theirs = program.run("form-factor", "floating-cube", "--from", from_, "--to", to).split()
        assert ours == tuple(map(float, theirs))
    assert penumbra.form_factor(scene, 0, list(scene.objects["cube"])) == penumbra.form_factor(scene, "plane", "cube")


@pytest.mark.parametrize("arguments, message", [
    (("plan", 0), "did you mean 'plane'?"), (("moon", 0), "no object or group 'moon'"), ((0, 99), "no face 99"),
    ((-1, 0), "no face -1"), (([], 0), "nothing is left"),
])
def test_names_that_are_not_there_are_refused(cube_solution, arguments, message):
    with pytest.raises(penumbra.InputError) as error:
        penumbra.form_factor(cube_solution.scene, *arguments)
    assert message in str(error.value)


def test_values_that_cannot_be_are_refused(cube_solution):
    for options in (dict(method="guess"), dict(tolerance=2), dict(rays=5), dict(method="monte-carlo", tolerance=0.1),
                    dict(method="monte-carlo", rays=0)):
        with pytest.raises(penumbra.InputError):
            penumbra.form_factor(cube_solution.scene, 0, 1, **options)
    with pytest.raises(TypeError, match="did you mean 'method'"):
        penumbra.form_factor(cube_solution.scene, 0, 1, methode="exact")


def test_matrix_of_a_closed_box_closes_and_is_reciprocal():
    """In a closed convex box each face sends all its flux to the others, and exchanges are symmetric."""
    scene = penumbra.Scene.read("furnace")
    factor, error, area = penumbra.form_factors(scene)
    assert factor.shape == error.shape == (len(area), len(area))
    exchange = area[:, None] * factor
    assert np.abs(exchange - exchange.T).max() <= 1e-14 * exchange.max()
    assert np.abs(factor.sum(axis=1) - 1).max() <= 1e-6
    one, its_error = penumbra.form_factor(scene, 0, 1)
    assert abs(one - factor[0, 1]) <= its_error + error[0, 1] + 1e-12


def test_unit_and_up_axis_turn_the_scene(tmp_path):
    """A scene in millimetres with y up is the scene in metres with z up."""
    file = tmp_path / "one.obj"
    file.write_text("v 0 0 0\nv 0 0 1000\nv 1000 0 1000\nv 1000 0 0\nf 1 2 3 4\n")
    scene = penumbra.Scene.read(file, unit="mm", up="y")
    factor, _, area = penumbra.form_factors(scene)
    assert area[0] == 1 and factor[0, 0] == 0
    with pytest.raises(penumbra.InputError, match="parsec"):
        penumbra.Scene.read(file, unit="parsec")
