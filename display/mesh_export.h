// display/mesh_export.h
//
// Irradiance meshes for other programs. The same mesh gives the same bytes.

#pragma once

#include <string>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

// VTK's XML for unstructured grids: quadratic triangles, which hold the interpolants themselves. Point data
// `irradiance` and `radiosity` [W/m^2], three channels in doubles; cell data `patch`, the number of the face
// as users count.
std::string VtuBytes(const Scene& scene, const IrradianceMesh& mesh);

// Binary PLY, little-endian: each triangle as four. Vertices carry float positions, `irradiance_r/g/b`,
// `radiosity_r/g/b` [W/m^2], and colours for a screen: the exposed radiosity [m^2/W times W/m^2] in sRGB,
// emitters white. Faces carry `patch`.
std::string PlyBytes(const Scene& scene, const IrradianceMesh& mesh, double exposure);

// Binary glTF 2.0: the same triangles, unlit, in the exposed radiosity as linear vertex colours, emitters
// white;
// `_IRRADIANCE` and `_RADIOSITY` [W/m^2] as attributes of the application. Its axes are y up: the node turns
// them.
std::string GlbBytes(const Scene& scene, const IrradianceMesh& mesh, double exposure);

// The exposure that MeterNodes() finds.
double MeterMesh(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
