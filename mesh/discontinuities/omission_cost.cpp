#include "mesh/discontinuities/omission_cost.h"

#include <algorithm>
#include <cmath>

namespace penumbra {
namespace {

Vec2 Middle(const OmittedPart& part) { return 0.5 * (part.from + part.to); }

double TwiceArea(std::span<const Vec2> polygon) {
  double twice = 0;
  for (std::size_t v = 1; v + 1 < polygon.size(); ++v)
    twice += Cross2(polygon[v] - polygon[0], polygon[v + 1] - polygon[0]);
  return std::max(twice, 0.0);
}

}  // namespace

double ErrorOnPiece(const OmittedPart& part, std::span<const Vec2> piece) {
  const Vec2 middle = Middle(part), along = (part.to - part.from).normalized(), across(-along.y(), along.x());
  double left = 0, right = 0;
  for (const Vec2& v : piece) {
    left = std::max(left, across.dot(v - middle));
    right = std::max(right, -across.dot(v - middle));
  }
  return ErrorWithout(part.jump, left + right, std::min(left, right));
}

OmissionCost::Cost OmissionCost::Of(std::size_t i, std::int32_t own,
                                    std::span<const std::vector<std::int32_t>> inside,
                                    std::span<const DiscontinuityLine> active) {
  double by_place = 0, at_most = 0, area = 0;
  for (Part& part : PartsOf(i)) {
    CutByLines(part, own, inside, active);
    const double error = ErrorOnPiece(part.segment, part.cell);
    const double square = error * error * 0.5 * TwiceArea(part.cell);
    const double most = std::max(part.scale, part.leaf_scale);
    by_place += part.scale * part.scale * square;
    at_most += most * most * square;
    area += part.leaf_area;
  }
  if (area == 0) return {};
  return {std::sqrt(by_place / area), std::sqrt(at_most / area)};
}

std::vector<OmittedPart> OmissionCost::PartsWithout(std::size_t i, std::int32_t own,
                                                    std::span<const std::vector<std::int32_t>> inside,
                                                    std::span<const DiscontinuityLine> active, double least) {
  std::vector<OmittedPart> without;
  for (Part& part : PartsOf(i)) {
    const std::vector<std::int32_t>& lines = inside[part.segment.leaf];
    if (own >= 0 && std::find(lines.begin(), lines.end(), own) != lines.end()) continue;
    CutByLines(part, own, inside, active);
    if (part.scale * ErrorOnPiece(part.segment, part.cell) >= least) without.push_back(part.segment);
  }
  return without;
}

std::span<OmissionCost::Part> OmissionCost::PartsOf(std::size_t i) {
  const std::size_t end = i + 1 < first_part_.size() ? first_part_[i + 1] : parts_.size();
  return std::span(parts_).subspan(first_part_[i], end - first_part_[i]);
}

void OmissionCost::CutByLines(Part& part, std::int32_t own, std::span<const std::vector<std::int32_t>> inside,
                              std::span<const DiscontinuityLine> active) {
  const std::vector<std::int32_t>& lines = inside[part.segment.leaf];
  for (; part.lines < lines.size(); ++part.lines)
    if (lines[part.lines] != own) Cut(part, active[lines[part.lines]]);
}

// Keeps the side of the line that contains the segment's midpoint.
void OmissionCost::Cut(Part& part, const DirectedLine& line) {
  const double side = line.Distance(Middle(part.segment)) >= 0 ? 1 : -1;
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
