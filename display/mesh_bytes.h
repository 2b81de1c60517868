// display/mesh_bytes.h
//
// Functions that the writers of mesh files (PLY, glTF and others) share.

#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "display/mesh_nodes.h"
#include "display/mesh_writer.h"

namespace penumbra {

static_assert(std::endian::native == std::endian::little, "all formats are written little-endian");

template <class T>
void AppendBytes(std::string& bytes, const T& value) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.append(raw.data(), raw.size());
}

template <class Scalar>
void AppendTriple(std::string& bytes, const auto& triple) {
  for (int i = 0; i < 3; ++i) AppendBytes(bytes, static_cast<Scalar>(triple[i]));
}

// The nodes of the mesh with their light (FindMeshNodes). `most` is the largest number that the file format
// can represent. Throws InputError if a value of a mesh node exceeds `most`.
MeshNodes NodesToWrite(const Scene& scene, const IrradianceMesh& mesh, double most);

// The exposure of the exported colours [m^2/W]: MeshExport::exposure if set, otherwise the result of
// MeterMesh().
double ExposureOf(const MeshExport& from);

// The linear colour of a mesh node on a screen: exposure * radiosity, or white if the node lies on an
// emitter.
Rgb ExposedAt(const Scene& scene, const MeshNodes::Node& node, double exposure);

}  // namespace penumbra
