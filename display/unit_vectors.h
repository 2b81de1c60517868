// display/unit_vectors.h
//
// Functions that return unit vectors, in place of glm::normalize(). glm::normalize() multiplies by the
// inverse of the length and thus rounds once more than a division, and returns NaN for a zero vector.

#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace penumbra {

// The unit vector along v; v itself if its length is 0.
inline glm::dvec3 Normalized(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : v;
}

// Returns the unit vector along v, like Normalized(), but is also correct if the squared length of v
// overflows or underflows.
inline glm::dvec3 StableNormalized(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const glm::dvec3 scaled = v / largest;
  const double square = glm::dot(scaled, scaled);
  return square > 0 ? v / (std::sqrt(square) * largest) : v;
}

// A unit vector perpendicular to v. The perpendicular vector lies in the plane z = 0, or, if v is parallel to
// the z axis, in the plane x = 0. REQUIRES: v is not zero.
inline glm::dvec3 Perpendicular(const glm::dvec3& v) {
  // below this ratio of x and y to z, the direction of (x, y) is rounding error
  constexpr double kAlong = 1e-12;
  const bool along_z = std::max(std::abs(v.x), std::abs(v.y)) <= kAlong * std::abs(v.z);
  return StableNormalized(along_z ? glm::dvec3(0, -v.z, v.y) : glm::dvec3(-v.y, v.x, 0));
}

}  // namespace penumbra
