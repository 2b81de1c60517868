"""The light in scenes of diffuse polygons: solve once, then ask anywhere.

    import penumbra
    scene = penumbra.Scene.read("cornell")
    solution = penumbra.solve(scene, error=0.05)
    exact, interpolated = solution.irradiance([[0.5, 0.5, 0]], [[0, 0, 1]])

Lengths are in metres; emittance, radiosity and irradiance in W/m^2; reflectance is in [0, 1). Colours are linear red,
green and blue. Results are those of the program `penumbra`, to the bit, for any number of threads.
"""

from .core import (Camera, InputError, Mesh, PenumbraWarning, Scene, Solution, Solver, __version__, form_factor,
                   form_factors, options, render, save_picture, set_threads, solve, threads)

__all__ = ["Camera", "InputError", "Mesh", "PenumbraWarning", "Scene", "Solution", "Solver", "__version__",
           "form_factor", "form_factors", "options", "render", "save_picture", "set_threads", "solve", "threads"]

for _shown in (Camera, Mesh, Scene, Solution, Solver, form_factor, form_factors, options, render, save_picture,
               set_threads, solve, threads):
    _shown.__module__ = __name__
del _shown
