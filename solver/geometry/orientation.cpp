#include "solver/geometry/orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

namespace penumbra {

int Orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  // Shewchuk's static filter decides nearly always: the determinant's rounding error is below this bound.
  constexpr double kFilter = 3.3306690738754716e-16;
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double determinant = left - right;
  const double bound = kFilter * (std::abs(left) + std::abs(right));
  constexpr double kNoUnderflow = 0x1p-900;
  if (std::abs(determinant) > bound && bound > kNoUnderflow) return determinant > 0 ? 1 : -1;
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  return static_cast<int>(CGAL::orientation(Point(a.x(), a.y()), Point(b.x(), b.y()), Point(c.x(), c.y())));
}

}  // namespace penumbra
