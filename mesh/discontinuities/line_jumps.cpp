#include "mesh/discontinuities/line_jumps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace penumbra {
namespace {

void AddTo(IrradianceJump& sum, const IrradianceJump& jump) {
  sum.gradient += jump.gradient;
  sum.curvature += jump.curvature;
  sum.largest_gradient += jump.largest_gradient;
  sum.largest_value += jump.largest_value;
}

// Identifies events in which the same edges share a plane.
using SharedEdges = std::array<std::int32_t, 4>;

SharedEdges SharedEdgesOf(const Discontinuity& d) {
  return {d.source, d.shared_source_edge, d.shared_blocker_edge.patch, d.shared_blocker_edge.k};
}

// The jumps of one discontinuity along a line of this direction, at one of the discontinuity's sample points.
LineJump JumpOf(const Discontinuity& d, int sample, const Vec2& direction) {
  const IrradianceJump& jump = d.jump[static_cast<std::size_t>(sample)];
  LineJump result;
  const bool kink = d.degree == DiscontinuityDegree::kD1 || !std::isfinite(jump.curvature);
  IrradianceJump& to = kink ? result.kink : result.bend;
  to.largest_gradient = d.strength * jump.largest_gradient;
  to.largest_value = d.strength * jump.largest_value;
  if (kink) {
    to.gradient = d.strength * jump.gradient;
  } else {
    // The jump of an odd derivative does not depend on the line's direction; the jump of an even derivative
    // does.
    to.curvature = (d.end[1] - d.end[0]).dot(direction) >= 0 ? d.strength * jump.curvature
                                                             : -d.strength * jump.curvature;
  }
  return result;
}

}  // namespace

void LineJump::Add(const LineJump& other) {
  AddTo(kink, other.kink);
  AddTo(bend, other.bend);
}

double ErrorWithout(const LineJump& jump, double size, double margin) {
  // The mean square is proportional to the smaller part's size, relative to half the piece: 1 in the middle.
  const double freed = size > 0 ? std::sqrt(2 * margin / size) : 0;
  return std::min(freed * jump.kink.largest_value, KinkError(size, margin) * std::abs(jump.kink.gradient)) +
         std::min({freed * jump.bend.largest_value, KinkError(size, margin) * jump.bend.largest_gradient,
                   BendError(size, margin) * std::abs(jump.bend.curvature)});
}

LineJumps::LineJumps(std::span<const Discontinuity> found, std::span<const std::int32_t> line_of,
                     std::span<const DiscontinuityLine> lines)
    : lines_(lines.size()) {
  std::vector<std::size_t> order(found.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Sorts events of the same edges together; D2 events have no shared edges.
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (line_of[a] != line_of[b]) return line_of[a] < line_of[b];
    const SharedEdges edges_a = SharedEdgesOf(found[a]), edges_b = SharedEdgesOf(found[b]);
    return edges_a != edges_b ? edges_a < edges_b : a < b;
  });
  std::vector<Piece> pieces, shared;
  std::vector<double> place;
  // Where several events of the same edges overlap, the first counts.
  const auto close = [&] {
    place.clear();
    for (const Piece& p : shared) {
      place.push_back(p.t0);
      place.push_back(p.t1);
    }
    std::sort(place.begin(), place.end());
    for (std::size_t i = 0; i + 1 < place.size(); ++i) {
      if (place[i] == place[i + 1]) continue;
      const auto holds = std::find_if(shared.begin(), shared.end(), [&](const Piece& p) {
        return p.t0 <= place[i] && p.t1 >= place[i + 1];
      });
      if (holds != shared.end()) pieces.push_back({place[i], place[i + 1], holds->jump});
    }
    shared.clear();
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Discontinuity& d = found[order[i]];
    const std::int32_t number = line_of[order[i]];
    const bool first = d.degree == DiscontinuityDegree::kD1;
    const DiscontinuityLine& line = lines[number];
    const double a = line.Along(d.end[0]), b = line.Along(d.end[1]);
    if (d.kind != DiscontinuityKind::kContact)
      for (int k = 0; k < Discontinuity::kJumps; ++k) {
        const double p = a + (b - a) * k / Discontinuity::kJumps;
        const double q = a + (b - a) * (k + 1) / Discontinuity::kJumps;
        (first ? shared : pieces).push_back({std::min(p, q), std::max(p, q), JumpOf(d, k, line.direction)});
      }
    const bool last_of_line = i + 1 == order.size() || line_of[order[i + 1]] != number;
    if (last_of_line || SharedEdgesOf(found[order[i + 1]]) != SharedEdgesOf(d)) close();
    if (!last_of_line) continue;
    lines_[number] = Sum(pieces);
    pieces.clear();
  }
}

LineJumps::Line LineJumps::Sum(std::span<const Piece> pieces) {
  Line line;
  for (const Piece& p : pieces) {
    line.place.push_back(p.t0);
    line.place.push_back(p.t1);
  }
  std::sort(line.place.begin(), line.place.end());
  line.place.erase(std::unique(line.place.begin(), line.place.end()), line.place.end());
  const std::size_t size = line.place.size();
  line.node.resize(2 * size);
  const auto index = [&](double t) {
    return static_cast<std::size_t>(std::lower_bound(line.place.begin(), line.place.end(), t) -
                                    line.place.begin());
  };
  for (const Piece& p : pieces)
    for (std::size_t from = index(p.t0) + size, to = index(p.t1) + size; from < to; from /= 2, to /= 2) {
      if (from % 2 == 1) line.node[from++].Add(p.jump);
      if (to % 2 == 1) line.node[--to].Add(p.jump);
    }
  return line;
}

LineJump LineJumps::At(std::int32_t number, double t) const {
  const Line& line = lines_[number];
  LineJump sum;
  const auto after = std::upper_bound(line.place.begin(), line.place.end(), t) - line.place.begin();
  if (after == 0) return sum;
  for (auto node = static_cast<std::size_t>(after) - 1 + line.place.size(); node >= 1; node /= 2)
    sum.Add(line.node[node]);
  return sum;
}

}  // namespace penumbra
