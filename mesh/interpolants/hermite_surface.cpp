#include "mesh/interpolants/hermite_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// The level at which a lattice point is first a corner of an element.
int LevelOf(const LatticePoint& p) {
  const auto bits = static_cast<std::uint32_t>(p.x) | static_cast<std::uint32_t>(p.y) |
                    static_cast<std::uint32_t>(kLatticeSize);
  return kMaxLevel - std::countr_zero(bits);
}

std::int32_t Coordinate(const LatticePoint& p, int axis) { return axis == 0 ? p.x : p.y; }

LatticePoint Moved(const LatticePoint& p, int axis, std::int32_t distance) {
  return axis == 0 ? LatticePoint{p.x + distance, p.y} : LatticePoint{p.x, p.y + distance};
}

double UnitLength(std::int32_t lattice_distance) {
  return static_cast<double>(lattice_distance) / kLatticeSize;
}

// A cubic Hermite function and its derivative: at the ends of the piece of length h, value and derivative are
// 0, but for one end, where either the value or the derivative is 1.
struct HermiteValue {
  double value, derivative;
};

// `a` is the position in the piece, from 0 to 1; `end` is the end, 0 or 1, that is not all 0.
HermiteValue ValueFunction(double a, int end) {
  const double b = end == 0 ? a : 1 - a, sign = end == 0 ? 1 : -1;
  return {(1 - b) * (1 - b) * (1 + 2 * b), sign * -6 * b * (1 - b)};
}
HermiteValue SlopeFunction(double a, int end) {
  const double b = end == 0 ? a : 1 - a, sign = end == 0 ? 1 : -1;
  return {sign * b * (1 - b) * (1 - b), (1 - b) * (1 - 3 * b)};
}

void AddProduct(const Rgb& factor, const HermiteValue& of_u, const HermiteValue& of_v,
                HermiteSurface::Jet& sum) {
  sum.value += of_u.value * of_v.value * factor;
  sum.by_u += of_u.derivative * of_v.value * factor;
  sum.by_v += of_u.value * of_v.derivative * factor;
  sum.by_uv += of_u.derivative * of_v.derivative * factor;
}

HermiteValue ScaledBy(const HermiteValue& f, double value, double derivative) {
  return {value * f.value, derivative * f.derivative};
}

// The derivative at 0 of the parabola through (0, f0), (a, fa) and (b, fb).
Rgb SlopeOfParabola(const Rgb& f0, double a, const Rgb& fa, double b, const Rgb& fb) {
  return ((fa - f0) * (b / a) - (fb - f0) * (a / b)) / (b - a);
}

}  // namespace

// The distances along edges of leaves to the next vertex, down and up each axis [lattice units]; 0: none. And
// the sum of the mixed derivatives of the leaves at the vertex.
struct HermiteSurface::Neighbours {
  std::array<std::array<std::int32_t, 2>, 2> distance = {};  // [axis][0: down, 1: up]
  Rgb twists = Rgb::Zero();
  int leaves = 0;

  void Add(int axis, int up, std::int32_t length) {
    std::int32_t& known = distance[static_cast<std::size_t>(axis)][static_cast<std::size_t>(up)];
    known = known == 0 ? length : std::min(known, length);
  }
  std::int32_t Distance(int axis, int up) const {
    return distance[static_cast<std::size_t>(axis)][static_cast<std::size_t>(up)];
  }
};

HermiteSurface::HermiteSurface(const ElementForest& forest, PatchId patch, const VertexLight& light) {
  PENUMBRA_CHECK(forest.scene().patches[static_cast<std::size_t>(patch)].size == 4);
  Vertices vertices;
  std::vector<LatticePoint> order;
  for (const ElementId id : forest.Leaves(patch)) {
    const Element& leaf = forest[id];
    const std::int32_t side = leaf.corner[1].x - leaf.corner[0].x;
    const double length = UnitLength(side);
    const Rgb twist = (light.at(leaf.corner[0]) - light.at(leaf.corner[1]) + light.at(leaf.corner[2]) -
                       light.at(leaf.corner[3])) /
                      (length * length);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [entry, is_new] = vertices.try_emplace(leaf.corner[k]);
      if (is_new) order.push_back(leaf.corner[k]);
      entry->second.Add(0, k == 0 || k == 3 ? 1 : 0, side);
      entry->second.Add(1, k < 2 ? 1 : 0, side);
      entry->second.twists += twist;
      ++entry->second.leaves;
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const LatticePoint& a, const LatticePoint& b) { return LevelOf(a) < LevelOf(b); });
  std::vector<Jet> corrections;
  for (std::size_t begin = 0; begin < order.size();) {
    // Corrections of one level do not change one another's values and derivatives.
    const int level = LevelOf(order[begin]);
    std::size_t end = begin;
    corrections.clear();
    for (; end < order.size() && LevelOf(order[end]) == level; ++end) {
      const LatticePoint& at = order[end];
      const Neighbours& around = vertices.at(at);
      const Jet coarse = Below(level, UnitLength(at.x), UnitLength(at.y));
      corrections.push_back({light.at(at) - coarse.value, DerivativeBy(0, at, vertices, light) - coarse.by_u,
                             DerivativeBy(1, at, vertices, light) - coarse.by_v,
                             around.twists / around.leaves - coarse.by_uv});
    }
    for (std::size_t i = begin; i < end; ++i) correction_.emplace(order[i], corrections[i - begin]);
    levels_ = level + 1;
    begin = end;
  }
}

// The light of the vertices of the first `levels` levels.
HermiteSurface::Jet HermiteSurface::Below(int levels, double u, double v) const {
  Jet sum;
  for (int level = 0; level < levels; ++level) {
    const double cells = std::ldexp(1.0, level), h = 1 / cells;
    const double i = std::min(std::floor(u * cells), cells - 1),
                 j = std::min(std::floor(v * cells), cells - 1);
    const std::int32_t step = kLatticeSize >> level;
    for (int corner = 0; corner < 4; ++corner) {
      const int right = corner % 2, up = corner / 2;
      const LatticePoint at = {(static_cast<std::int32_t>(i) + right) * step,
                               (static_cast<std::int32_t>(j) + up) * step};
      if (LevelOf(at) != level) continue;
      const auto found = correction_.find(at);
      if (found == correction_.end()) continue;
      const Jet& jet = found->second;
      const double a = u * cells - i, b = v * cells - j;
      const HermiteValue value_u = ScaledBy(ValueFunction(a, right), 1, cells),
                         value_v = ScaledBy(ValueFunction(b, up), 1, cells),
                         slope_u = ScaledBy(SlopeFunction(a, right), h, 1),
                         slope_v = ScaledBy(SlopeFunction(b, up), h, 1);
      AddProduct(jet.value, value_u, value_v, sum);
      AddProduct(jet.by_u, slope_u, value_v, sum);
      AddProduct(jet.by_v, value_u, slope_v, sum);
      AddProduct(jet.by_uv, slope_u, slope_v, sum);
    }
  }
  return sum;
}

// The given value at a vertex, or the light of the levels coarser than `level` elsewhere.
Rgb HermiteSurface::ValueAt(const LatticePoint& at, int level, const VertexLight& light) const {
  const auto found = light.find(at);
  return found != light.end() ? found->second : Below(level, UnitLength(at.x), UnitLength(at.y)).value;
}

Rgb HermiteSurface::DerivativeBy(int axis, const LatticePoint& at, const Vertices& vertices,
                                 const VertexLight& light) const {
  const int level = LevelOf(at);
  const std::int32_t own = kLatticeSize >> level;  // size of the elements of the vertex's level
  // The distance to the next place on the line whose light is known; 0 beyond the border.
  const auto next = [&](const LatticePoint& from, int up) -> std::int32_t {
    const auto found = vertices.find(from);
    const std::int32_t along_edge = found != vertices.end() ? found->second.Distance(axis, up) : 0;
    if (along_edge > 0) return along_edge;
    const std::int32_t room = up == 1 ? kLatticeSize - Coordinate(from, axis) : Coordinate(from, axis);
    return std::min(own, room);
  };
  const Rgb& here = light.at(at);
  const std::int32_t down = next(at, 0), up = next(at, 1);
  std::int32_t first = -down, second = up;
  if (down == 0 || up == 0) {  // at the border: two places on the same side
    const int side = down == 0 ? 1 : 0;
    const std::int32_t sign = down == 0 ? 1 : -1, near = down == 0 ? up : down;
    const std::int32_t far = next(Moved(at, axis, sign * near), side);
    first = sign * near;
    if (far == 0) return (ValueAt(Moved(at, axis, first), level, light) - here) / UnitLength(first);
    second = sign * (near + far);
  }
  return SlopeOfParabola(here, UnitLength(first), ValueAt(Moved(at, axis, first), level, light),
                         UnitLength(second), ValueAt(Moved(at, axis, second), level, light));
}

}  // namespace penumbra
