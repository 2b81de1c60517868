// solver/geometry/vec.h
//
// The vector types of the solver and the mesh; all components are binary64 numbers.

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace penumbra {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

// A linear RGB colour with one value per channel: a reflectance [1], or an emittance, radiosity or irradiance
// [W/m^2].
using Rgb = Eigen::Array3d;

inline double Cross2(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// The largest absolute value of the vector's coordinates.
inline double MaxAbs(const Vec3& v) { return v.cwiseAbs().maxCoeff(); }

}  // namespace penumbra
