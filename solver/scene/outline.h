// solver/scene/outline.h

#pragma once

#include <cstdint>
#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// A simple polygon, an intermediate result between faces and patches: a face without its straight corners, a
// triangle of a face that is not planar, or two joined triangles.
struct Outline {
  Polygon3 vertices;
  std::vector<std::int32_t> faces;
  std::int32_t material = 0;
  std::int32_t object = 0;
  std::int32_t owners = 0;            // a number for each set of objects that contain the face
  Vec3 normal = Vec3::Zero();         // unit
  double diameter = 0;                // [m]
  bool is_piece = false;              // one of the triangles of a face that is not planar
  bool joined = false;                // merged into an outline with a lower index
  std::vector<std::int32_t> winners;  // sorted: outlines whose overlap is removed from this one
};

}  // namespace penumbra
