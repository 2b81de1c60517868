// display/mesh_bytes.h
//
// What the writers of meshes share.

#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "display/mesh_nodes.h"

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

// The nodes of the mesh. Throws InputError if one holds a value above `most`, which the format cannot hold.
MeshNodes NodesToWrite(const Scene& scene, const IrradianceMesh& mesh, double most);

// What a screen shows of a node, linear: the exposed radiosity, emitters white.
Rgb ExposedAt(const Scene& scene, const MeshNodes::Node& node, double exposure);

}  // namespace penumbra
