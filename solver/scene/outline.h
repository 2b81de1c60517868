// solver/scene/outline.h

#pragma once

#include <cstdint>
#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// A simple polygon on its way to patches: a face without its straight corners, a triangle of one that is not
// planar, or two triangles joined.
struct Outline {
  Polygon3 vertices;
  std::vector<std::int32_t> faces;
  std::int32_t material = 0;
  std::int32_t object = 0;
  std::int32_t owners = 0;            // equal for faces that belong to the same objects
  Vec3 normal = Vec3::Zero();         // unit
  double diameter = 0;                // [m]
  bool is_piece = false;              // of a face that is not planar
  bool joined = false;                // into the outline of a lower index
  std::vector<std::int32_t> winners;  // ascending: outlines that cut this one
};

}  // namespace penumbra
