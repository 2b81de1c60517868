// display/glm_conversion.h
//
// All conversions between the vectors of solver and mesh (Eigen, double) and those of the display (GLM), and
// from double to float.

#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "solver/geometry/vec.h"

namespace penumbra {

// Conversions between the vector types of Eigen and GLM, without rounding.
inline glm::dvec3 ToGlm(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Vec3 ToEigen(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Rounds each component to the nearest float, for the graphics API.
inline glm::vec3 ToFloats(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

inline glm::vec4 ToFloats(const glm::dvec4& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(v.w)};
}

// Rounds each channel to the nearest float. The components x, y and z of a pixel vector are red, green and
// blue.
inline glm::vec3 ToPixel(const Rgb& colour) {
  return {static_cast<float>(colour[0]), static_cast<float>(colour[1]), static_cast<float>(colour[2])};
}

}  // namespace penumbra
