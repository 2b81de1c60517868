#include "solver/visibility/form_factor_batch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/check.h"
#include "solver/base/vector_dispatch.h"
#include "solver/visibility/arc_tangent.h"
#include "solver/visibility/form_factor.h"

namespace penumbra {
namespace {

// One edge's share of 2 pi times the negated form factor; its angle is added to `angles`. a is the edge's
// start, b its end, p the point, n its normal.
[[gnu::always_inline]] inline double EdgeTerm(double ax, double ay, double az, double bx, double by,
                                              double bz, double px, double py, double pz, double nx,
                                              double ny, double nz, double& angles) {
  // The edge from the original coordinates: what is close to it keeps its digits.
  const double ex = bx - ax, ey = by - ay, ez = bz - az;
  const double rx = ax - px, ry = ay - py, rz = az - pz;
  const double qx = bx - px, qy = by - py, qz = bz - pz;
  // a x b = a x e = b x e, with the most digits from the end that is nearer.
  const bool near = rx * rx + ry * ry + rz * rz < qx * qx + qy * qy + qz * qz;
  const double sx = near ? rx : qx, sy = near ? ry : qy, sz = near ? rz : qz;
  const double mx = sy * ez - sz * ey, my = sz * ex - sx * ez, mz = sx * ey - sy * ex;
  const double length = std::sqrt(mx * mx + my * my + mz * mz);
  const double cosine = rx * qx + ry * qy + rz * qz;
  const double rise = nx * mx + ny * my + nz * mz;
  const double angle = internal::AngleOf(length, cosine);
  angles += angle;
  return rise / (length > 0 ? length : 1.0) * angle;
}

// out[i] is the sum over the edges of polygon i, turned[i] that of their angles. c[3 k + axis] points to the
// coordinates of the k-th vertices.
PENUMBRA_VECTOR_CLONES
void Kernel(const std::array<const double*, 12>& c, std::size_t count, double px, double py, double pz,
            double nx, double ny, double nz, double* __restrict out, double* __restrict turned) {
  const double* __restrict x0 = c[0], * __restrict y0 = c[1], * __restrict z0 = c[2];
  const double* __restrict x1 = c[3], * __restrict y1 = c[4], * __restrict z1 = c[5];
  const double* __restrict x2 = c[6], * __restrict y2 = c[7], * __restrict z2 = c[8];
  const double* __restrict x3 = c[9], * __restrict y3 = c[10], * __restrict z3 = c[11];
  for (std::size_t i = 0; i < count; ++i) {
    double angles = 0;
    const double first = EdgeTerm(x0[i], y0[i], z0[i], x1[i], y1[i], z1[i], px, py, pz, nx, ny, nz, angles);
    const double second = EdgeTerm(x1[i], y1[i], z1[i], x2[i], y2[i], z2[i], px, py, pz, nx, ny, nz, angles);
    const double third = EdgeTerm(x2[i], y2[i], z2[i], x3[i], y3[i], z3[i], px, py, pz, nx, ny, nz, angles);
    const double fourth = EdgeTerm(x3[i], y3[i], z3[i], x0[i], y0[i], z0[i], px, py, pz, nx, ny, nz, angles);
    // Counter-clockwise about a normal that points to the point: the sum is negative.
    const double sum = -((first + second) + (third + fourth));
    out[i] = (sum > 0 ? sum : 0) * (0.5 / std::numbers::pi);
    turned[i] = angles;
  }
}

}  // namespace

double FormFactorByQuadrature(const PolygonBatch& batch, std::size_t i, const Vec3& position,
                              const Vec3& normal) {
  const auto vertex = [&](std::size_t k) {
    return Vec3(batch.Coordinates(k, 0)[i], batch.Coordinates(k, 1)[i], batch.Coordinates(k, 2)[i]);
  };
  // Clockwise as seen is counter-clockwise about the direction of sight.
  const Vec3 first = vertex(0);
  const std::array<Vec3, 4> offset = {Vec3::Zero(), vertex(3) - first, vertex(2) - first, vertex(1) - first};
  return FormFactorByQuadrature(first - position, offset, normal);
}

void PolygonBatch::Add(std::span<const Vec3> polygon) {
  PENUMBRA_CHECK(polygon.size() == 3 || polygon.size() == 4);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      coordinate_[3 * k + axis].push_back(
          polygon[std::min(k, polygon.size() - 1)][static_cast<Eigen::Index>(axis)]);
}

void PolygonBatch::Clear() {
  for (std::vector<double>& coordinates : coordinate_) coordinates.clear();
}

void FormFactorSums(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
                    const Vec3& normal, double* out, double* angles) {
  std::array<const double*, 12> corner;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) corner[3 * k + axis] = batch.Coordinates(k, axis) + begin;
  Kernel(corner, end - begin, position.x(), position.y(), position.z(), normal.x(), normal.y(), normal.z(),
         out, angles);
}

void FormFactors(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
                 const Vec3& normal, double* out) {
  constexpr std::size_t kBlock = 128;
  std::array<double, kBlock> angles;
  for (std::size_t first = begin; first < end; first += kBlock) {
    const std::size_t count = std::min(kBlock, end - first);
    double* factor = out + (first - begin);
    FormFactorSums(batch, first, first + count, position, normal, factor, angles.data());
    for (std::size_t i = 0; i < count; ++i)
      if (angles[i] > 2 * std::numbers::pi * kFormFactorCancellation * factor[i])
        factor[i] = FormFactorByQuadrature(batch, first + i, position, normal);
  }
}

}  // namespace penumbra
