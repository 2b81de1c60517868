// display/mesh_export.h
//
// Writes irradiance meshes for other programs. The same mesh gives the same bytes.

#pragma once

#include <string>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The mesh in VTK's XML format for unstructured grids: quadratic triangles, which represent the interpolants
// exactly. Point data: `irradiance` and `radiosity` [W/m^2], three channels in doubles. Cell data: `patch`,
// the number of the face in outputs.
std::string VtuBytes(const Scene& scene, const IrradianceMesh& mesh);

// The mesh as binary PLY, little-endian, with four triangles for each triangle of the mesh. Vertices have
// float positions, `irradiance_r/g/b`, `radiosity_r/g/b` [W/m^2], and sRGB colours: radiosity times
// `exposure` [m^2/W], emitters white. Faces have `patch`, as in VtuBytes().
std::string PlyBytes(const Scene& scene, const IrradianceMesh& mesh, double exposure);

// The mesh as binary glTF 2.0: the triangles of PlyBytes() with an unlit material and linear vertex colours,
// radiosity times `exposure` [m^2/W], emitters white. The application-specific attributes `_IRRADIANCE` and
// `_RADIOSITY` are in W/m^2. glTF has y up; the node rotates the axes.
std::string GlbBytes(const Scene& scene, const IrradianceMesh& mesh, double exposure);

// The exposure that MeterNodes() finds for the nodes of the mesh [m^2/W].
double MeterMesh(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
