"""Pictures as arrays."""

import numpy as np
import pytest

import penumbra


def test_pictures_are_those_of_the_command_line(program, cube_solution, tmp_path):
    cube_solution.save(tmp_path / "cube.sol")
    for source, mode, samples in (("floating-cube", "interpolant", 1), ("floating-cube", "exact", 1),
                                  ("floating-cube", "lerp", 2), ("cube.sol", "flat", 1), ("cube.sol", "gouraud", 1),
                                  ("cube.sol", "gouraud-mesh", 1), ("cube.sol", "rho", 1), ("cube.sol", "bicubic", 1),
                                  ("floating-cube", "nodal", 2)):
        image = penumbra.render(cube_solution, size=(40, 30), mode=mode, samples=samples)
        assert image.shape == (30, 40, 3) and image.dtype == np.float32
        penumbra.save_picture(tmp_path / "ours.exr", image)
        program.run("render", source, "-o", "theirs.exr", "--mode", mode, "--size", "40x30",
                    *(["--error", "0.1"] if source == "floating-cube" else []),
                    *(["--samples", samples] if samples > 1 else []))
        assert (tmp_path / "ours.exr").read_bytes() == (tmp_path / "theirs.exr").read_bytes(), mode


def test_a_furnace_looks_the_same_everywhere(box):
    vertices, faces = box
    solution = penumbra.solve(penumbra.Scene(vertices, faces, reflectance=0.5, emittance=(1, 2, 3)), error=0.01)
    camera = penumbra.Camera((1, 1, 1), (3, 2, 1.5), fov=90)
    for mode in ("interpolant", "exact", "flat"):
        image = penumbra.render(solution, camera, size=(16, 9), mode=mode)
        assert np.allclose(image, [2, 4, 6], rtol=1e-3)  # radiosity M / (1 - rho)


def test_cameras_are_named_numbered_or_given(cube_solution):
    cameras = cube_solution.scene.cameras
    first = penumbra.render(cube_solution, size=(8, 6))
    given = penumbra.Camera(cameras[0].eye, cameras[0].look_at, cameras[0].up, cameras[0].fov)
    for camera in (0, cameras[0], cameras[0].name, given):
        assert np.array_equal(penumbra.render(cube_solution, camera, size=(8, 6)), first)
    assert not np.array_equal(penumbra.render(cube_solution, 1, size=(8, 6)), first)


@pytest.mark.parametrize("options, message", [
    (dict(camera="nowhere"), "the scene has no camera 'nowhere'"), (dict(camera=9), "no camera 9"),
    (dict(mode="round"), "there is no mode 'round'"), (dict(size=(0, 5)), "size=(0, 5)"),
    (dict(size=(30000, 30000)), "size="), (dict(samples=4), "samples is of modes that cast rays"),
    (dict(samples=0, mode="exact"), "samples=0"),
])
def test_what_cannot_be_drawn_is_refused(cube_solution, options, message):
    with pytest.raises(penumbra.InputError) as error:
        penumbra.render(cube_solution, **options)
    assert message in str(error.value)


def test_bad_cameras_and_paths_are_refused(cube_solution, tmp_path):
    for eye, look_at in (((0, 0, 0), (0, 0, 0)), ((0, 0), (1, 0, 0)), ((np.nan, 0, 0), (1, 0, 0))):
        with pytest.raises(penumbra.InputError):
            penumbra.Camera(eye, look_at)
    with pytest.raises(penumbra.InputError):
        penumbra.Camera((0, 0, 0), (1, 0, 0), fov=190)
    with pytest.raises(penumbra.InputError, match="end in .exr"):
        penumbra.save_picture(tmp_path / "a.png", np.zeros((2, 2, 3)))
    with pytest.raises(penumbra.InputError, match="image has the shape"):
        penumbra.save_picture(tmp_path / "a.exr", np.zeros((2, 2)))
