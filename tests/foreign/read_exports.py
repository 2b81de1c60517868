"""Exports are opened by programs that share nothing with ours, and hold what ours say.

    read_exports.py PENUMBRA ASSIMP SCRATCH

meshio reads the VTU, assimp the PLY, GLB, and OBJ; h5py is not needed.
"""

import json
import pathlib
import re
import subprocess
import sys

import meshio
import numpy

program, assimp, scratch = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
scratch.mkdir(parents=True, exist_ok=True)


def run(*arguments):
    return subprocess.run(arguments, cwd=scratch, check=True, capture_output=True, text=True).stdout


def demand(condition, what):
    if not condition:
        sys.exit("failed: " + what)


run(program, "solve", "floating-cube", "--error", "0.1", "-o", "a.h5")
info = json.loads(run(program, "info", "a.h5", "--json"))
triangles = info["solution"]["tables"]["mesh_triangles"]
for name in "a.vtu", "a.ply", "a.glb", "a.obj":
    run(program, "export", "a.h5", "-o", name)
run(program, "export", "floating-cube", "--error", "0.1", "-o", "b.vtu")
demand((scratch / "a.vtu").read_bytes() == (scratch / "b.vtu").read_bytes(), "file and scene give one VTU")

# The quadratic triangles cover the fronts, and the integral of irradiance over a flat one is exact from the
# middles of its edges alone: A/3 x their sum. Absorbed power follows.
mesh = meshio.read(scratch / "a.vtu")
cells = mesh.cells_dict["triangle6"]
demand(len(cells) == triangles, "every triangle is a quadratic cell")
corners = mesh.points[cells[:, :3]]
middles = mesh.points[cells[:, 3:]]
demand(numpy.allclose(middles, 0.5 * (corners + numpy.roll(corners, -1, axis=1)), atol=1e-12), "order of the nodes")
areas = 0.5 * numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
demand(abs(areas.sum() - info["area"]) < 1e-9 * info["area"], "the mesh covers the fronts")
patches = mesh.cell_data_dict["patch"]["triangle6"].ravel()
demand(set(patches) == set(range(info["faces"])), "every face has its triangles")

# At the nodes, what probe says.
irradiance, radiosity = mesh.point_data["irradiance"], mesh.point_data["radiosity"]
normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
chosen = range(0, len(cells), max(1, len(cells) // 20))
rows = [",".join(repr(float(x)) for x in (*corners[i].mean(axis=0), *normals[i])) for i in chosen]
(scratch / "points.csv").write_text("x,y,z,nx,ny,nz\n" + "\n".join(rows) + "\n")
probed = numpy.genfromtxt(run(program, "probe", "a.h5", "--points", "points.csv").splitlines(), delimiter=",", skip_header=1)
# A quadratic at the centre of its triangle: 4/9 of each middle less 1/9 of each corner.
centre = (4 * irradiance[cells[chosen, 3:]].sum(axis=1) - irradiance[cells[chosen, :3]].sum(axis=1)) / 9
demand(numpy.allclose(numpy.maximum(centre, 0), probed[:, 10:13], rtol=1e-6, atol=1e-9), "the interpolants themselves")
demand((probed[:, 6] == patches[chosen]).all(), "patch is the number of the face")
demand((radiosity >= -1e-9).all() and radiosity.max() > irradiance.max(), "emitters shine")


def numbers(name, key):
    line = next(line for line in run(assimp, "info", name).splitlines() if line.startswith(key))
    return [float(word) for word in line[len(key):].strip(" ()").split()]


low, high = info["bounds"]["min"], info["bounds"]["max"]
for name in "a.ply", "a.glb":
    demand(numbers(name, "Faces:") == [4 * triangles], name + ": four triangles for each")
    demand("Vertices:" in run(assimp, "info", name), name + ": vertices")
demand(numpy.allclose(numbers("a.ply", "Minimum point"), low, atol=1e-5), "bounds of the PLY")
demand(numpy.allclose(numbers("a.ply", "Maximum point"), high, atol=1e-5), "bounds of the PLY")
# glTF has y up: (x, y, z) is (x, z, -y) there.
demand(numpy.allclose(numbers("a.glb", "Minimum point"), [low[0], low[2], -high[1]], atol=1e-5), "bounds of the GLB")
demand(numpy.allclose(numbers("a.glb", "Maximum point"), [high[0], high[2], -low[1]], atol=1e-5), "bounds of the GLB")
demand(numpy.allclose(numbers("a.obj", "Minimum point"), low, atol=1e-5), "bounds of the OBJ")

# The map in a GLB: the patches alone, in the same place, with one picture and both sets of coordinates.
run(program, "export", "a.h5", "--atlas", "256", "-o", "map.glb")
told = run(assimp, "info", "map.glb")
demand(re.search(r"Textures \(embed\.\):\s+1\b", told), "the picture of the map")
demand(numbers("map.glb", "Faces:")[0] >= info["faces"], "a triangle or more for each face")
demand(numpy.allclose(numbers("map.glb", "Minimum point"), [low[0], low[2], -high[1]], atol=1e-5), "bounds of the map")
print("read", triangles, "triangles")
