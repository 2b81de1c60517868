#include "solver/visibility/point/form_factor_batch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/check.h"
#include "solver/base/vector_dispatch.h"
#include "solver/visibility/point/arc_tangent.h"
#include "solver/visibility/point/form_factor.h"

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

// Polygons of which no edge has a larger squared sine as seen are small.
constexpr double kSmallSine2 = 0.04;

// asin(s) / s = 1 + s^2 (c[0] + c[1] s^2 + ...); what is left out is below 2e-14 of s^2 / 6 where s^2 is
// kSmallSine2.
constexpr std::array<double, 9> kArcSine = {1.0 / 6,       3.0 / 40,        5.0 / 112,
                                            35.0 / 1152,   63.0 / 2816,     231.0 / 13312,
                                            143.0 / 10240, 6435.0 / 557056, 12155.0 / 1245184};

// A term of a small polygon is off by some ten roundings of its size, one of other polygons by two of its
// angle.
constexpr double kRoundingsOfSmall = 5;

// What an edge a -> b of a small polygon adds to the sum about a vertex at squared distance `square`, which
// `a` and `b` are `da` and `db` further from, squared: n . (a x b) (angle / |a x b| - 1 / square). The size
// of that without n is added to `sizes`, and `sine2` becomes at least the edge's squared sine, or 1 if its
// angle is not acute.
[[gnu::always_inline]] inline double SmallEdgeTerm(double ax, double ay, double az, double bx, double by,
                                                   double bz, double ex, double ey, double ez, double da,
                                                   double db, double square, double nx, double ny, double nz,
                                                   double& sizes, double& sine2) {
  const double aa = square + da, bb = square + db;
  const bool near = aa < bb;
  const double sx = near ? ax : bx, sy = near ? ay : by, sz = near ? az : bz;
  const double mx = sy * ez - sz * ey, my = sz * ex - sx * ez, mz = sx * ey - sy * ex;
  const double product = std::sqrt(aa * bb);
  const double sine2_here = (mx * mx + my * my + mz * mz) / (aa * bb);
  double h = kArcSine[8];
#pragma GCC unroll 8
  for (int k = 7; k >= 0; --k) h = h * sine2_here + kArcSine[static_cast<std::size_t>(k)];
  // 1 / product - 1 / square, without cancellation.
  const double change = -(square * (da + db) + da * db) / (product * square * (square + product));
  const double weight = change + h * sine2_here / product;
  const double cosine = ax * bx + ay * by + az * bz;
  const double sine2_or_more = cosine > 0 ? sine2_here : 1.0;
  sine2 = sine2 > sine2_or_more ? sine2 : sine2_or_more;
  sizes += (std::abs(mx) + std::abs(my) + std::abs(mz)) * std::abs(weight);
  return (nx * mx + ny * my + nz * mz) * weight;
}

// Where polygon i is small: out[i] is its sum, added[i] the size of what was added. Elsewhere added[i] is
// negative.
PENUMBRA_VECTOR_CLONES
void SmallKernel(const std::array<const double*, 12>& c, std::size_t count, double px, double py, double pz,
                 double nx, double ny, double nz, double* __restrict out, double* __restrict added) {
  const double* __restrict x0 = c[0], * __restrict y0 = c[1], * __restrict z0 = c[2];
  const double* __restrict x1 = c[3], * __restrict y1 = c[4], * __restrict z1 = c[5];
  const double* __restrict x2 = c[6], * __restrict y2 = c[7], * __restrict z2 = c[8];
  const double* __restrict x3 = c[9], * __restrict y3 = c[10], * __restrict z3 = c[11];
  for (std::size_t i = 0; i < count; ++i) {
    const double ax = x0[i] - px, ay = y0[i] - py, az = z0[i] - pz;
    const double ux = x1[i] - x0[i], uy = y1[i] - y0[i], uz = z1[i] - z0[i];
    const double vx = x2[i] - x0[i], vy = y2[i] - y0[i], vz = z2[i] - z0[i];
    const double wx = x3[i] - x0[i], wy = y3[i] - y0[i], wz = z3[i] - z0[i];
    const double bx = ax + ux, by = ay + uy, bz = az + uz;
    const double qx = ax + vx, qy = ay + vy, qz = az + vz;
    const double dx = ax + wx, dy = ay + wy, dz = az + wz;
    const double square = ax * ax + ay * ay + az * az;
    const double du = ux * (ax + bx) + uy * (ay + by) + uz * (az + bz);
    const double dv = vx * (ax + qx) + vy * (ay + qy) + vz * (az + qz);
    const double dw = wx * (ax + dx) + wy * (ay + dy) + wz * (az + dz);
    double sizes = 0, sine2 = 0;
    const double first =
        SmallEdgeTerm(ax, ay, az, bx, by, bz, ux, uy, uz, 0, du, square, nx, ny, nz, sizes, sine2);
    const double second = SmallEdgeTerm(bx, by, bz, qx, qy, qz, x2[i] - x1[i], y2[i] - y1[i], z2[i] - z1[i],
                                        du, dv, square, nx, ny, nz, sizes, sine2);
    const double third = SmallEdgeTerm(qx, qy, qz, dx, dy, dz, x3[i] - x2[i], y3[i] - y2[i], z3[i] - z2[i],
                                       dv, dw, square, nx, ny, nz, sizes, sine2);
    const double fourth =
        SmallEdgeTerm(dx, dy, dz, ax, ay, az, -wx, -wy, -wz, dw, 0, square, nx, ny, nz, sizes, sine2);
    // Twice the area vector, about the first vertex.
    const double gx = (uy * vz - uz * vy) + (vy * wz - vz * wy),
                 gy = (uz * vx - ux * vz) + (vz * wx - vx * wz),
                 gz = (ux * vy - uy * vx) + (vx * wy - vy * wx);
    sizes += (std::abs(gx) + std::abs(gy) + std::abs(gz)) / square;
    const double sum = -((nx * gx + ny * gy + nz * gz) / square + ((first + second) + (third + fourth)));
    out[i] = (sum > 0 ? sum : 0) * (0.5 / std::numbers::pi);
    added[i] = sine2 <= kSmallSine2 ? kRoundingsOfSmall * sizes : -1;
  }
}

// out[i] is the sum over the edges of polygon i, added[i] that of their angles. c[3 k + axis] points to the
// coordinates of the k-th vertices.
PENUMBRA_VECTOR_CLONES
void Kernel(const std::array<const double*, 12>& c, std::size_t count, double px, double py, double pz,
            double nx, double ny, double nz, double* __restrict out, double* __restrict added) {
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
    added[i] = angles;
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

void PolygonBatch::AddFrom(const PolygonBatch& other, std::size_t i) {
  for (std::size_t k = 0; k < coordinate_.size(); ++k) coordinate_[k].push_back(other.coordinate_[k][i]);
}

std::array<const double*, 12> PolygonBatch::Columns(std::size_t first) const {
  std::array<const double*, 12> columns;
  for (std::size_t k = 0; k < columns.size(); ++k) columns[k] = coordinate_[k].data() + first;
  return columns;
}

void PolygonBatch::Clear() {
  for (std::vector<double>& coordinates : coordinate_) coordinates.clear();
}

void FormFactorSums(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
                    const Vec3& normal, double* out, double* added) {
  SmallKernel(batch.Columns(begin), end - begin, position.x(), position.y(), position.z(), normal.x(),
              normal.y(), normal.z(), out, added);
  thread_local std::vector<std::size_t> large;
  large.clear();
  for (std::size_t i = 0; i < end - begin; ++i)
    if (added[i] < 0) large.push_back(i);
  if (large.empty()) return;
  thread_local PolygonBatch gathered;
  thread_local std::vector<double> factor, angles;
  gathered.Clear();
  for (const std::size_t i : large) gathered.AddFrom(batch, begin + i);
  factor.resize(large.size());
  angles.resize(large.size());
  Kernel(gathered.Columns(0), large.size(), position.x(), position.y(), position.z(), normal.x(), normal.y(),
         normal.z(), factor.data(), angles.data());
  for (std::size_t k = 0; k < large.size(); ++k) {
    out[large[k]] = factor[k];
    added[large[k]] = angles[k];
  }
}

void FormFactors(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
                 const Vec3& normal, double* out) {
  constexpr std::size_t kBlock = 128;
  std::array<double, kBlock> added;
  for (std::size_t first = begin; first < end; first += kBlock) {
    const std::size_t count = std::min(kBlock, end - first);
    double* factor = out + (first - begin);
    FormFactorSums(batch, first, first + count, position, normal, factor, added.data());
    for (std::size_t i = 0; i < count; ++i)
      if (added[i] > 2 * std::numbers::pi * kFormFactorCancellation * factor[i])
        factor[i] = FormFactorByQuadrature(batch, first + i, position, normal);
  }
}

}  // namespace penumbra
