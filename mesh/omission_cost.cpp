#include "mesh/omission_cost.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

void OmissionCost::AddPart(std::size_t leaf, const Polygon2& outline, double area, const Vec2& a,
                           const Vec2& b, const LineJump& jump) {
  const Vec2 along = (b - a).normalized();
  parts_.push_back({leaf, area, 0.5 * (a + b), {-along.y(), along.x()}, jump, outline, 0});
}

double OmissionCost::Of(std::size_t i, std::int32_t own, std::span<const std::vector<std::int32_t>> inside,
                        std::span<const DiscontinuityLine> active) {
  const std::size_t end = i + 1 < first_part_.size() ? first_part_[i + 1] : parts_.size();
  double squares = 0, area = 0;
  for (std::size_t k = first_part_[i]; k < end; ++k) {
    Part& part = parts_[k];
    const std::vector<std::int32_t>& lines = inside[part.leaf];
    for (; part.lines < lines.size(); ++part.lines)
      if (lines[part.lines] != own) Cut(part, active[lines[part.lines]]);
    double left = 0, right = 0, twice = 0;
    for (std::size_t v = 0; v < part.cell.size(); ++v) {
      const Vec2 from = part.cell[v] - part.middle;
      const Vec2 to = part.cell[(v + 1) % part.cell.size()] - part.middle;
      left = std::max(left, part.across.dot(from));
      right = std::max(right, -part.across.dot(from));
      twice += Cross2(from, to);
    }
    const double error = ErrorWithout(part.jump, left + right, std::min(left, right));
    squares += error * error * 0.5 * std::max(twice, 0.0);
    area += part.leaf_area;
  }
  return area > 0 ? std::sqrt(squares / area) : 0;
}

// Keeps the side of the line on which the segment's middle lies.
void OmissionCost::Cut(Part& part, const DirectedLine& line) {
  const double side = line.Distance(part.middle) >= 0 ? 1 : -1;
  kept_.clear();
  for (std::size_t k = 0; k < part.cell.size(); ++k) {
    const Vec2 &a = part.cell[k], &b = part.cell[(k + 1) % part.cell.size()];
    const double da = side * line.Distance(a), db = side * line.Distance(b);
    if (da >= 0) kept_.push_back(a);
    if ((da >= 0) != (db >= 0)) kept_.push_back(a + da / (da - db) * (b - a));
  }
  part.cell.swap(kept_);
}

}  // namespace penumbra
