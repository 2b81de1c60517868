// solver/scene/outline.h

#pragma once

#include <cstdint>
#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// An outline is a simple polygon, an intermediate result between the faces of a file and the patches of the
// scene. An outline is a face without its straight corners, a triangle of a face that is not planar, or two
// joined triangles.
struct Outline {
  Polygon3 vertices;
  std::vector<std::int32_t> faces;
  std::int32_t material = 0;
  std::int32_t object = 0;
  std::int32_t owners = 0;     // the index of the set of objects that contain the outline's face
  Vec3 normal = Vec3::Zero();  // the unit normal on the front of the outline
  double diameter = 0;         // the largest distance between two vertices of the outline [m]
  bool is_piece = false;       // true if the outline is a triangle of a face that is not planar
  bool joined = false;         // true if the outline was merged into an outline with a lower index
  // The sorted indices of the outlines that keep their overlap with this outline: each such overlap is
  // removed from this outline.
  std::vector<std::int32_t> winners;
};

}  // namespace penumbra
