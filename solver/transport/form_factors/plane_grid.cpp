#include "solver/transport/form_factors/plane_grid.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

// (cosine at the point) * (cosine at the plane) / (pi * squared distance), for the point (x, y) of the plane.
double KernelAt(const PlaneGrid& grid, const Vec2& p) {
  const Vec3 way = p.x() * grid.right + p.y() * grid.up + grid.ahead;
  const double square = way.squaredNorm();
  return std::max(0.0, way.z()) / (std::numbers::pi * square * square);
}

double SquareFactor(const PlaneGrid& grid, std::span<const Vec2> corners) {
  std::array<Vec3, 4> vertex;
  for (std::size_t i = 0; i < corners.size(); ++i)
    vertex[i] = corners[i].x() * grid.right + corners[i].y() * grid.up + grid.ahead;
  return std::abs(FormFactor(Vec3::Zero(), {vertex.data(), corners.size()}, Vec3::UnitZ()));
}

}  // namespace

void FindDeltas(PlaneGrid* grid, CellRule rule) {
  const double side = grid->cell, area = side * side;
  grid->delta.assign(static_cast<std::size_t>(grid->columns) * static_cast<std::size_t>(grid->rows), 0);
  for (int row = 0; row < grid->rows; ++row)
    for (int column = 0; column < grid->columns; ++column) {
      const bool half = grid->halved && column == grid->columns - 1 - row;
      if (column < grid->FirstWhole(row) && !half) continue;
      const Vec2 a = grid->low + side * Vec2(column, row), c = a + Vec2(side, side);
      const std::array<Vec2, 4> corners = {a, Vec2(c.x(), a.y()), c, Vec2(a.x(), c.y())};
      double delta = 0;
      if (rule == CellRule::kExact)
        delta = SquareFactor(*grid, half ? std::span(corners).subspan(1) : std::span(corners));
      else
        delta = half ? area / 2 * KernelAt(*grid, c) : area * KernelAt(*grid, (a + c) / 2);
      grid->delta[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid->columns) +
                  static_cast<std::size_t>(column)] = delta;
    }
}

double SumOfDeltas(const PlaneGrid& grid) {
  return std::accumulate(grid.delta.begin(), grid.delta.end(), 0.0);
}

}  // namespace penumbra
