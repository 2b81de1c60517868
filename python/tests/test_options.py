"""The options of solve() are those of the one table."""

import ast
import inspect
import json
import os

import numpy as np
import pytest

import penumbra


def test_every_option_is_taken_by_its_name(cube_solution, program):
    known = penumbra.options()
    assert {"error", "eps", "min_area", "solver", "seed"} <= set(known)
    # As the command line tells them in its help.
    told = program.run("solve", "--help")
    for name, option in known.items():
        dashed = name.replace("_", "-")
        assert f"--{dashed}" in told or f"--no-{dashed}" in told
        assert option["kind"] in ("bool", "int", "float", "str") and option["help"]
    # All defaults together are the default.
    defaults = {name: option["default"] for name, option in known.items()
                if option["solvers"] is None or "hierarchical" in option["solvers"]}
    solution = penumbra.solve(cube_solution.scene, **{**defaults, "error": 0.1})
    assert np.array_equal(solution.mesh.coefficients, cube_solution.mesh.coefficients)


def test_none_leaves_the_default_and_numpy_scalars_are_numbers(cube_solution):
    a = penumbra.solve(cube_solution.scene, error=np.float64(0.1), eps=None, seed=np.int64(1), multigrid=np.bool_(False))
    assert np.array_equal(a.mesh.coefficients, cube_solution.mesh.coefficients)


@pytest.mark.parametrize("options, kind, message", [
    (dict(eror=0.1), TypeError, "did you mean 'error'?"),
    (dict(minarea=0.1), TypeError, "did you mean 'min_area'"),
    (dict(error="0.1"), TypeError, "error is of the type str; give a number from 1e-6 to 10"),
    (dict(error=True), TypeError, "error is of the type bool"),
    (dict(seed=1.5), TypeError, "seed is of the type float; give an integer"),
    (dict(error=0), penumbra.InputError, "error=0 is not a number from 1e-6 to 10"),
    (dict(error=float("nan")), penumbra.InputError, "error=nan is not"),
    (dict(solver="dens"), penumbra.InputError, "did you mean 'dense'?"),
    (dict(solver="dense", eps=0.1), penumbra.InputError, "eps is of the hierarchical solver"),
    (dict(nudge=1.0), penumbra.InputError, "nudge 1 is too far for this scene"),
    (dict(source_error=0.1, corrections=0), penumbra.InputError, "leave one out"),
    (dict(progress=3), TypeError, "progress is no function"),
])
def test_what_cannot_be_is_refused_clearly(cube_solution, options, kind, message):
    with pytest.raises(kind) as error:
        penumbra.solve(cube_solution.scene, **options)
    assert message in str(error.value) and "--" not in str(error.value)
    if "progress" not in options:
        with pytest.raises(kind):
            penumbra.Solver(cube_solution.scene, **options)


def test_what_a_solve_used_gives_the_same_again(cube_solution):
    known = penumbra.options()
    used = {name: value for name, value in cube_solution.options.items() if name in known}
    again = penumbra.solve(cube_solution.scene, **used)
    assert np.array_equal(again.mesh.coefficients, cube_solution.mesh.coefficients)
    json.dumps(cube_solution.options)


def _stub():
    path = os.path.join(os.path.dirname(penumbra.__file__), "__init__.pyi")
    with open(path, encoding="utf-8") as file:
        return ast.parse(file.read())


def test_the_types_name_all_that_there_is():
    classes, functions = {}, {}
    for node in _stub().body:
        if isinstance(node, ast.ClassDef):
            classes[node.name] = {member.name for member in node.body if isinstance(member, ast.FunctionDef)}
        if isinstance(node, ast.FunctionDef):
            functions[node.name] = [argument.arg for argument in node.args.kwonlyargs]
    for name in penumbra.__all__:
        thing = getattr(penumbra, name)
        if inspect.isclass(thing) and not issubclass(thing, BaseException):
            members = {member for member in vars(thing) if not member.startswith("_")}
            assert members == {member for member in classes[name] if not member.startswith("_")}, name
        elif callable(thing) and not inspect.isclass(thing):
            assert name in functions
    assert set(functions["solve"]) == set(penumbra.options()) | {"measure", "progress"}


def test_everything_is_documented():
    for name in penumbra.__all__:
        thing = getattr(penumbra, name)
        if not callable(thing):
            continue
        assert thing.__doc__, name
        for member, value in vars(thing).items() if inspect.isclass(thing) else ():
            if not member.startswith("_"):
                assert getattr(thing, member).__doc__, f"{name}.{member}"
    assert all(f"\n{name} : " in penumbra.solve.__doc__ for name in penumbra.options())
    assert "--" not in penumbra.solve.__doc__
