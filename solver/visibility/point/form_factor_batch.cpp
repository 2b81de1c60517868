#include "solver/visibility/point/form_factor_batch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/check.h"
#include "solver/base/scratch.h"
#include "solver/base/vector_dispatch.h"
#include "solver/visibility/point/arc_tangent.h"
#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

// A vector of plain numbers. The compiler vectorises loops over polygons.
struct Triple {
  double x, y, z;
};

[[gnu::always_inline]] inline Triple operator-(const Triple& a, const Triple& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Triple operator+(const Triple& a, const Triple& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] inline double Dot(const Triple& a, const Triple& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] inline Triple Cross(const Triple& a, const Triple& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[gnu::always_inline]] inline Triple Choose(bool first, const Triple& a, const Triple& b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

// The coordinates of the k-th vertices of all polygons, one column for each axis.
struct VertexColumns {
  const double* __restrict x;
  const double* __restrict y;
  const double* __restrict z;

  VertexColumns(const std::array<const double*, 12>& columns, std::size_t k)
      : x(columns[3 * k]), y(columns[3 * k + 1]), z(columns[3 * k + 2]) {}
  [[gnu::always_inline]] inline Triple operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

// The term of the edge from a to b in -2 pi times the form factor of the point p with normal n. Adds the
// edge's angle to `angles`.
[[gnu::always_inline]] inline double EdgeTerm(const Triple& a, const Triple& b, const Triple& p,
                                              const Triple& n, double& angles) {
  // The edge vector from the original coordinates, so that close edges keep their digits.
  const Triple e = b - a, r = a - p, q = b - p;
  // a x b = a x e = b x e; the nearer end gives the most digits.
  const Triple m = Cross(Choose(Dot(r, r) < Dot(q, q), r, q), e);
  const double length = std::sqrt(Dot(m, m));
  const double angle = internal::AngleOf(length, Dot(r, q));
  angles += angle;
  return Dot(n, m) / (length > 0 ? length : 1.0) * angle;
}

// Polygons are small if no edge has a larger squared sine as seen from the point.
constexpr double kSmallSine2 = 0.04;

// asin(s) / s = 1 + s^2 (c[0] + c[1] s^2 + ...). For s^2 = kSmallSine2, the truncated terms are less than
// 2e-14 of s^2 / 6.
constexpr std::array<double, 9> kArcSine = {1.0 / 6,       3.0 / 40,        5.0 / 112,
                                            35.0 / 1152,   63.0 / 2816,     231.0 / 13312,
                                            143.0 / 10240, 6435.0 / 557056, 12155.0 / 1245184};

// The error of a term of a small polygon is about ten roundings of the term's size; that of other polygons is
// two roundings of the angle.
constexpr double kRoundingsOfSmall = 5;

// A vertex of a small polygon relative to the point, and its squared distance minus that of the first vertex.
struct SmallVertex {
  Triple at;
  double farther;
};

// Sums over the edges of a small polygon, besides the terms.
struct SmallSums {
  double sizes = 0;  // sizes of the terms, without the factor n
  double sine2 = 0;  // largest squared sine of an edge; 1 if an angle is not acute
};

// The term of an edge a -> b = a + e of a small polygon in the sum about the first vertex: n . (a x b) (angle
// / |a x b| - 1 / square). `square` is the squared distance of the first vertex.
[[gnu::always_inline]] inline double SmallEdgeTerm(const SmallVertex& a, const SmallVertex& b,
                                                   const Triple& e, double square, const Triple& n,
                                                   SmallSums& sums) {
  const double aa = square + a.farther, bb = square + b.farther;
  const Triple m = Cross(Choose(aa < bb, a.at, b.at), e);
  const double product = std::sqrt(aa * bb);
  const double sine2 = Dot(m, m) / (aa * bb);
  double h = kArcSine[8];
#pragma GCC unroll 8
  for (int k = 7; k >= 0; --k) h = h * sine2 + kArcSine[static_cast<std::size_t>(k)];
  // 1 / product - 1 / square, without cancellation.
  const double change =
      -(square * (a.farther + b.farther) + a.farther * b.farther) / (product * square * (square + product));
  const double weight = change + h * sine2 / product;
  const double sine2_or_more = Dot(a.at, b.at) > 0 ? sine2 : 1.0;
  sums.sine2 = sums.sine2 > sine2_or_more ? sums.sine2 : sine2_or_more;
  sums.sizes += (std::abs(m.x) + std::abs(m.y) + std::abs(m.z)) * std::abs(weight);
  return Dot(n, m) * weight;
}

// If polygon i is small, sets out[i] to its form factor and added[i] to the size of the terms; otherwise sets
// added[i] to a negative number. columns[3 k + axis] points to the coordinates of the k-th vertices.
PENUMBRA_VECTOR_CLONES
void SmallKernel(const std::array<const double*, 12>& columns, std::size_t count, Triple p, Triple n,
                 double* __restrict out, double* __restrict added) {
  const VertexColumns v0(columns, 0), v1(columns, 1), v2(columns, 2), v3(columns, 3);
  for (std::size_t i = 0; i < count; ++i) {
    const Triple a = v0[i] - p;
    const Triple u = v1[i] - v0[i], v = v2[i] - v0[i], w = v3[i] - v0[i];
    const Triple b = a + u, c = a + v, d = a + w;
    const double square = Dot(a, a);
    const SmallVertex at_a{a, 0}, at_b{b, Dot(u, a + b)}, at_c{c, Dot(v, a + c)}, at_d{d, Dot(w, a + d)};
    SmallSums sums;
    const double first = SmallEdgeTerm(at_a, at_b, u, square, n, sums);
    const double second = SmallEdgeTerm(at_b, at_c, v2[i] - v1[i], square, n, sums);
    const double third = SmallEdgeTerm(at_c, at_d, v3[i] - v2[i], square, n, sums);
    const double fourth = SmallEdgeTerm(at_d, at_a, {-w.x, -w.y, -w.z}, square, n, sums);
    const Triple twice_area = Cross(u, v) + Cross(v, w);  // about the first vertex
    const double sizes =
        sums.sizes + (std::abs(twice_area.x) + std::abs(twice_area.y) + std::abs(twice_area.z)) / square;
    const double sum = -(Dot(n, twice_area) / square + ((first + second) + (third + fourth)));
    out[i] = (sum > 0 ? sum : 0) * (0.5 / std::numbers::pi);
    added[i] = sums.sine2 <= kSmallSine2 ? kRoundingsOfSmall * sizes : -1;
  }
}

// Sets out[i] to the form factor of polygon i by the sum over its edges, and added[i] to the sum of the
// angles.
PENUMBRA_VECTOR_CLONES
void LargeKernel(const std::array<const double*, 12>& columns, std::size_t count, Triple p, Triple n,
                 double* __restrict out, double* __restrict added) {
  const VertexColumns v0(columns, 0), v1(columns, 1), v2(columns, 2), v3(columns, 3);
  for (std::size_t i = 0; i < count; ++i) {
    double angles = 0;
    const double first = EdgeTerm(v0[i], v1[i], p, n, angles);
    const double second = EdgeTerm(v1[i], v2[i], p, n, angles);
    const double third = EdgeTerm(v2[i], v3[i], p, n, angles);
    const double fourth = EdgeTerm(v3[i], v0[i], p, n, angles);
    // Vertices are counter-clockwise about a normal that points to the point, so the sum is negative.
    const double sum = -((first + second) + (third + fourth));
    out[i] = (sum > 0 ? sum : 0) * (0.5 / std::numbers::pi);
    added[i] = angles;
  }
}

Triple TripleOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

double FormFactorByQuadrature(const PolygonBatch& batch, std::size_t i, const Vec3& position,
                              const Vec3& normal) {
  const auto vertex = [&](std::size_t k) {
    return Vec3(batch.Coordinates(k, 0)[i], batch.Coordinates(k, 1)[i], batch.Coordinates(k, 2)[i]);
  };
  // Reverses the order: clockwise as seen is counter-clockwise about the direction of sight.
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

void FormFactorSums::Find(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
                          const Vec3& normal) {
  const std::size_t count = end - begin;
  const Triple p = TripleOf(position), n = TripleOf(normal);
  factor_.resize(count);
  size_added_.resize(count);
  SmallKernel(batch.Columns(begin), count, p, n, factor_.data(), size_added_.data());
  large_.clear();
  for (std::size_t i = 0; i < count; ++i)
    if (size_added_[i] < 0) large_.push_back(i);
  if (large_.empty()) return;
  large_polygons_.Clear();
  for (const std::size_t i : large_) large_polygons_.AddFrom(batch, begin + i);
  large_factor_.resize(large_.size());
  large_size_added_.resize(large_.size());
  LargeKernel(large_polygons_.Columns(0), large_.size(), p, n, large_factor_.data(),
              large_size_added_.data());
  for (std::size_t k = 0; k < large_.size(); ++k) {
    factor_[large_[k]] = large_factor_[k];
    size_added_[large_[k]] = large_size_added_[k];
  }
}

void FormFactorSums::Clear() {
  factor_.clear();
  size_added_.clear();
}

void FormFactors(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
                 const Vec3& normal, double* out) {
  const Scratch<FormFactorSums> sums;
  sums->Find(batch, begin, end, position, normal);
  for (std::size_t i = 0; i < end - begin; ++i)
    out[i] = sums->SizeAdded(i) > 2 * std::numbers::pi * kFormFactorCancellation * sums->Factor(i)
                 ? FormFactorByQuadrature(batch, begin + i, position, normal)
                 : sums->Factor(i);
}

}  // namespace penumbra
