"""Long work: progress, interrupts, threads and memory."""

import os
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import penumbra
from conftest import box_arrays, points_on_plane

SLOW = dict(error=1e-4)  # takes far longer than a test may


def test_progress_is_told_in_this_thread(cube_solution):
    told = []
    penumbra.solve(cube_solution.scene, error=0.05, measure=True,
                   progress=lambda phase, fraction: told.append((phase, fraction, threading.get_ident())))
    assert {"link", "measure"} <= {phase for phase, _, _ in told}
    assert all(0 <= fraction <= 1 for _, fraction, _ in told)
    assert {thread for _, _, thread in told} == {threading.get_ident()}


def test_what_progress_raises_ends_the_work(cube_solution):
    class Enough(Exception):
        pass

    def progress(phase, fraction):
        raise Enough(phase)
    begin = time.monotonic()
    with pytest.raises(Enough):
        penumbra.solve(penumbra.Scene.read("office"), progress=progress, **SLOW)
    assert time.monotonic() - begin < 5


def _interrupt_soon(seconds):
    def send():
        time.sleep(seconds)
        os.kill(os.getpid(), signal.SIGINT)
    thread = threading.Thread(target=send)
    thread.start()
    return thread


def test_ctrl_c_ends_the_work():
    scene = penumbra.Scene.read("office")
    sender = _interrupt_soon(0.3)
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        penumbra.solve(scene, **SLOW)
    assert time.monotonic() - begin < 5
    sender.join()
    # What comes afterwards is as if nothing had been.
    assert len(penumbra.solve(penumbra.Scene.read("floating-cube"), error=0.2).mesh) > 0


def test_an_interrupted_step_can_be_made_again():
    scene = penumbra.Scene.read("cornell")
    solver, undisturbed = penumbra.Solver(scene, error=0.1), penumbra.Solver(scene, error=0.1)

    def stop(phase, fraction):
        raise KeyboardInterrupt
    with pytest.raises(KeyboardInterrupt):
        while True:
            solver.step(progress=stop)
    while undisturbed.step():
        pass
    while solver.step():
        pass
    assert solver.flux == undisturbed.flux


def test_other_threads_run_meanwhile(cube_solution):
    counted, done = 0, threading.Event()

    def count():
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)
    counter = threading.Thread(target=count)
    counter.start()
    begin = time.monotonic()
    points, _ = points_on_plane(20000)
    points[:, 2] = 0
    cube_solution.irradiance(points, [0, 0, 1])
    seconds = time.monotonic() - begin
    done.set()
    counter.join()
    assert seconds > 0.05, "the work is too short to tell"
    assert counted > 20 * seconds  # without Python's lock it would stand still


def test_several_threads_solve_and_ask_at_once(cube_solution):
    points, normals = points_on_plane(60)
    expected = cube_solution.irradiance(points, normals)[0]
    results, errors = [None] * 6, []

    def work(i):
        try:
            solution = cube_solution if i % 2 else penumbra.solve(cube_solution.scene, error=0.1)
            results[i] = solution.irradiance(points, normals)[0]
            assert penumbra.render(cube_solution, size=(8, 6), mode="flat").shape == (6, 8, 3)
            assert solution.report["counts"]["triangles"] == len(solution.mesh)
        except Exception as error:  # pylint: disable=broad-except
            errors.append(error)
    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(results))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not errors
    assert all(np.array_equal(result, expected) for result in results)


def resident_bytes():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def test_memory_does_not_grow_from_solve_to_solve():
    vertices, faces = box_arrays()
    emittance = [[0.0]] * 5 + [[10.0]]

    def solve_and_ask(count):
        for _ in range(count):
            solution = penumbra.solve(penumbra.Scene(vertices, faces, emittance=emittance), error=1)
            solution.irradiance([1, 1, 0], [0, 0, 1])
            solution.mesh.coefficients.sum()
            solution.report
            try:
                penumbra.solve(solution.scene, error=-1)
            except penumbra.InputError:
                pass
    solve_and_ask(50)
    before = resident_bytes()
    solve_and_ask(200)
    # A leak of 20 kB a solve, one small mesh, would be 4 MB; the allocator itself wavers by less.
    assert resident_bytes() - before < 3e6


def test_it_ends_quietly_with_a_thread_at_work():
    script = ("import threading, penumbra\n"
              "scene = penumbra.Scene.read('cornell')\n"
              "threading.Thread(target=penumbra.solve, args=(scene,), kwargs={'error': 0.2}).start()\n")
    folder = os.path.dirname(os.path.dirname(penumbra.__file__))
    done = subprocess.run([sys.executable, "-c", script], env={**os.environ, "PYTHONPATH": folder}, capture_output=True,
                          text=True)
    assert (done.returncode, done.stderr) == (0, "")
