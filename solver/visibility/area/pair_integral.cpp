#include "solver/visibility/area/pair_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/base/parallel.h"
#include "solver/visibility/area/event_lines.h"
#include "solver/visibility/area/kronrod_rule.h"
#include "solver/visibility/area/quad.h"
#include "solver/visibility/pair/tube_blockers.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/occlusion_method.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

// From QUADPACK: for an analytic integrand, the error of the Kronrod value is the 1.5th power of the
// difference.
constexpr double kAnalyticScale = 200;

// Rounding error of a cell's value, relative to the value. Without blockers, point form factors are exact to
// kFormFactorError; with blockers, the edges of shadows are intersections of planes.
constexpr double kClearNoise = 1e-14, kShadowNoise = 1e-12;

// Cells narrower than this times the area's diameter are not cut.
constexpr double kLeastWidth = 1e-13;

// Number of lines along which cells are cut before the first evaluation, so that small lit parts are not
// missed.
constexpr std::size_t kForcedLines = 16;

// No form factor needs a smaller error: a tenth of the rounding of 1. A strip of 1e-6 of a wall then has ten
// digits.
constexpr double kLeastAllowed = 2e-17;

// Fraction of the remaining error that may stay in the cells that a round does not refine.
constexpr double kLeftAlone = 0.3;

// Cells whose errors sum to less than this fraction of the requested error need no refinement either.
constexpr double kLeftOfAsked = 0.5;

// The points of a rule resolve a change if its width is more than this fraction of the gap between the
// nearest points on either side of the line.
constexpr double kSeenInGap = 0.5;

// Error of a point's position, in roundings relative to the patch's extent.
constexpr double kPointRoundings = 4;
// A form factor depends on distance^-2 and two cosines: a relative move d / distance changes it by at most 4
// d / distance, relatively.
constexpr double kFallOff = 4;

struct Cell {
  Quad quad;
  std::vector<PatchId> blockers;
  std::vector<std::int32_t> lines;  // lines that cross the cell
  double value = 0;                 // the cell's part of the integral [m^2]
  double error_s = 0, error_t = 0;  // errors of the value along the two parameters
  double unseen = 0;                // value that may be hidden by lines with all sample points on one side
  std::int32_t unseen_line = -1;    // the line with the largest such value
  bool shadowed = false;            // a blocker may hide a part
  bool settled = false;             // a further split would gain nothing
  std::size_t points = 0;

  double Error() const { return error_s + error_t + unseen; }
};

// Integrates, over a convex part of one patch, the form factor to a convex part of another.
class PairIntegral {
 public:
  PairIntegral(const Scene& scene, const PartPair& parts, std::vector<PatchId> blockers,
               const AreaFormFactorOptions& options);

  // [m^2]
  FormFactorEstimate Integrate();

 private:
  bool Crosses(std::int32_t line, const Cell& cell) const;
  void InheritLines(const Cell& parent, Cell& cell) const;
  Cell PartOf(const Cell& parent, const Quad& quad) const;
  void Cut(const Cell& cell, const EventLine& line, std::vector<Cell>& parts) const;
  void Split(const Cell& cell, std::vector<Cell>& parts) const;
  void FindUnseen(Cell& cell, double largest) const;
  double Visible(const Vec2& p, std::span<const PatchId> blockers) const;
  template <std::size_t N>
  void Evaluate(Cell& cell, const KronrodRule<N>& rule) const;
  void Evaluate(Cell& cell) const;

  const Scene& scene_;
  PatchId receiver_;
  double sender_area_;  // [m^2]
  Polygon3 source_part_;
  SightPair pair_;
  AreaFormFactorOptions options_;
  EventLines events_;
  std::vector<Cell> cells_;
};

PairIntegral::PairIntegral(const Scene& scene, const PartPair& parts, std::vector<PatchId> blockers,
                           const AreaFormFactorOptions& options)
    : scene_(scene),
      receiver_(parts.receiver),
      sender_area_(parts.sender_area),
      source_part_(parts.ends.source),
      options_(options) {
  const TubeEnds& ends = parts.ends;
  const Patch& patch = scene.patches[receiver_];
  pair_.source = parts.source;
  pair_.frame = PolygonFrame(ends.receiver);
  pair_.frame.n = patch.normal;
  for (const Vec3& v : ends.receiver) pair_.area.push_back(pair_.frame.ToPlane(v));
  const auto local = [&](const Vec3& v) {
    const Vec2 p = pair_.frame.ToPlane(v);
    return Vec3(p.x(), p.y(), pair_.frame.n.dot(v - pair_.frame.origin));
  };
  for (const Vec3& v : source_part_) pair_.local_source.push_back(local(v));
  pair_.diameter = Diameter(ends.receiver);
  pair_.source_breadth = Diameter(source_part_);
  for (std::size_t i = 0; i < source_part_.size(); ++i) {
    const Vec3 &p = source_part_[i], &q = source_part_[(i + 1) % source_part_.size()];
    double breadth = 0;
    for (const Vec3& v : source_part_)
      breadth = std::max(breadth, (q - p).cross(v - p).norm() / (q - p).norm());
    pair_.source_breadth = std::min(pair_.source_breadth, breadth);
  }
  events_ = FindEventLines(scene, pair_, blockers);

  std::vector<Quad> quads;
  AddQuads(pair_.area, quads);
  for (const Quad& quad : quads) {
    Cell cell;
    cell.quad = quad;
    cell.blockers = blockers;
    cell.lines.resize(events_.lines.size());
    std::iota(cell.lines.begin(), cell.lines.end(), 0);
    std::erase_if(cell.lines, [&](std::int32_t l) { return !Crosses(l, cell); });
    cells_.push_back(std::move(cell));
  }
  // The lines are sorted by weight.
  for (std::size_t l = 0, forced = 0; l < events_.lines.size(); ++l) {
    if (!events_.lines[l].grade && ++forced > kForcedLines) continue;
    std::vector<Cell> cut;
    for (const Cell& cell : cells_)
      if (std::find(cell.lines.begin(), cell.lines.end(), static_cast<std::int32_t>(l)) != cell.lines.end())
        Cut(cell, events_.lines[l], cut);
      else
        cut.push_back(cell);
    cells_ = std::move(cut);
  }
}

// True if a stretch of the line runs through the cell, away from the cell's border.
bool PairIntegral::Crosses(std::int32_t l, const Cell& cell) const {
  const EventLine& line = events_.lines[static_cast<std::size_t>(l)];
  double lowest = 0, highest = 0;
  for (const Vec2& p : cell.quad) {
    const double height = line.normal.dot(p) - line.offset;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  const double least = kSameLine * pair_.diameter;
  if (lowest >= -least || highest <= least) return false;
  const Stretch inside = Inside(line, ToPolygon(cell.quad));
  return std::min(line.high, inside.high) - std::max(line.low, inside.low) > least;
}

void PairIntegral::InheritLines(const Cell& parent, Cell& cell) const {
  cell.lines.clear();
  for (const std::int32_t l : parent.lines)
    if (Crosses(l, cell)) cell.lines.push_back(l);
}

Cell PairIntegral::PartOf(const Cell& parent, const Quad& quad) const {
  Cell part;
  part.quad = quad;
  part.blockers = parent.blockers;
  InheritLines(parent, part);
  return part;
}

void PairIntegral::Cut(const Cell& cell, const EventLine& line, std::vector<Cell>& parts) const {
  const Polygon2 polygon = ToPolygon(cell.quad);
  Polygon2 above, below;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const auto height = [&](const Vec2& p) {
      const double h = line.normal.dot(p) - line.offset;
      return std::abs(h) <= kLeastWidth * pair_.diameter ? 0 : h;
    };
    const double ha = height(a), hb = height(b);
    if (ha >= 0) above.push_back(a);
    if (ha <= 0) below.push_back(a);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) {
      const Vec2 crossing = a + (b - a) * (ha / (ha - hb));
      above.push_back(crossing);
      below.push_back(crossing);
    }
  }
  std::vector<Quad> quads;
  if (above.size() >= 3) AddQuads(above, quads);
  if (below.size() >= 3) AddQuads(below, quads);
  for (const Quad& quad : quads) parts.push_back(PartOf(cell, quad));
}

// Cuts the cell along the line with the largest unseen value, else along the line with the largest weight x
// length, else in half across the direction of the larger error.
void PairIntegral::Split(const Cell& cell, std::vector<Cell>& parts) const {
  if (cell.unseen > std::max(cell.error_s, cell.error_t))
    return Cut(cell, events_.lines[static_cast<std::size_t>(cell.unseen_line)], parts);
  const EventLine* best = nullptr;
  double largest = 0;
  const Polygon2 polygon = ToPolygon(cell.quad);
  for (const std::int32_t l : cell.lines) {
    const EventLine& line = events_.lines[static_cast<std::size_t>(l)];
    if (!IsCastByAny(line, cell.blockers)) continue;
    const Stretch inside = Inside(line, polygon);
    const double share = line.weight * (std::min(line.high, inside.high) - std::max(line.low, inside.low));
    if (share > largest) {
      largest = share;
      best = &line;
    }
  }
  if (best) return Cut(cell, *best, parts);
  const Quad& q = cell.quad;
  std::array<Quad, 2> halves;
  if (cell.error_s >= cell.error_t) {
    const Vec2 low = 0.5 * (q[0] + q[1]), high = 0.5 * (q[3] + q[2]);
    halves = {Quad{q[0], low, high, q[3]}, Quad{low, q[1], q[2], high}};
  } else {
    const Vec2 low = q[3] == q[0] ? q[0] : Vec2(0.5 * (q[0] + q[3])), high = 0.5 * (q[1] + q[2]);
    halves = {Quad{q[0], q[1], high, low}, Quad{low, high, q[2], q[3]}};
  }
  for (const Quad& half : halves) parts.push_back(PartOf(cell, half));
}

double PairIntegral::Visible(const Vec2& p, std::span<const PatchId> blockers) const {
  ReceiverPoint at;
  at.position = pair_.frame.FromPlane(p);
  at.normal = pair_.frame.n;
  PointView view(scene_, at, options_.method ? *options_.method : FastestExactMethod());
  if (!view.FaceSource(pair_.source)) return 0;
  const DirectionPolygon seen = view.SeeSource(source_part_);
  if (seen.empty()) return 0;
  std::vector<Occluder>& occluders = view.occluder_stack();
  if (!view.FindBlockers(blockers, receiver_, seen, occluders)) return 0;
  return view.VisibleFormFactor(seen, occluders);
}

template <std::size_t N>
void PairIntegral::Evaluate(Cell& cell, const KronrodRule<N>& rule) const {
  double both = 0, gauss_s = 0, gauss_t = 0, largest = 0;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j) {
      const double s = rule.node[i], t = rule.node[j];
      const double visible = Visible(At(cell.quad, s, t), cell.blockers);
      const double value = Jacobian(cell.quad, s, t) * visible;
      largest = std::max(largest, visible);
      both += rule.kronrod[i] * rule.kronrod[j] * value;
      gauss_s += rule.gauss[i] * rule.kronrod[j] * value;
      gauss_t += rule.kronrod[i] * rule.gauss[j] * value;
    }
  cell.value = both;
  cell.error_s = std::abs(both - gauss_s);
  cell.error_t = std::abs(both - gauss_t);
  cell.points = N * N;
  if (cell.shadowed && !cell.lines.empty()) FindUnseen(cell, largest);
}

// Sums up the values that lines may hide: lines that cross the cell with all sample points on one side, or
// with no point near enough to resolve the change. Except at contacts, the width of the change is the
// distance of the event or the breadth of the source's image.
void PairIntegral::FindUnseen(Cell& cell, double largest) const {
  constexpr KronrodRule<7> rule = kSeven;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  constexpr std::size_t kNodes = 7;
  std::array<Vec2, kNodes * kNodes> points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = At(cell.quad, rule.node[i / kNodes], rule.node[i % kNodes]);
  const Polygon2 polygon = ToPolygon(cell.quad);
  largest = std::max(largest, Visible(points[points.size() / 2], {}));
  double worst = 0;
  for (const std::int32_t l : cell.lines) {
    const EventLine& line = events_.lines[static_cast<std::size_t>(l)];
    double above = kNone, below = kNone;  // distances of the nearest points
    for (const Vec2& p : points) {
      const double height = line.normal.dot(p) - line.offset;
      double& nearest = height > 0 ? above : below;
      nearest = std::min(nearest, std::abs(height));
    }
    const bool one_side = above == kNone || below == kNone;
    const double gap = std::max(above, below);
    if ((!one_side && line.reach > kSeenInGap * gap) || !IsCastByAny(line, cell.blockers)) continue;
    const Stretch inside = Inside(line, polygon);
    const double scale = std::min(
        pair_.source_breadth, Reach(line, std::max(line.low, inside.low), std::min(line.high, inside.high)));
    const double length = inside.high - inside.low;
    double hidden = 0;
    if (one_side) {
      double depth = 0;
      for (const Vec2& p : polygon)
        depth = std::max(depth, (below == kNone ? -1 : 1) * (line.normal.dot(p) - line.offset));
      hidden = depth * length * largest * (depth < scale ? depth / scale : 1);
    } else if (scale < kSeenInGap * gap) {
      hidden = scale * length * largest;
    } else {
      continue;
    }
    cell.unseen += hidden;
    if (hidden <= worst) continue;
    worst = hidden;
    cell.unseen_line = l;
  }
}

void PairIntegral::Evaluate(Cell& cell) const {
  if (!cell.blockers.empty()) {
    TubeEnds ends;
    for (const Vec2& p : ToPolygon(cell.quad)) ends.receiver.push_back(pair_.frame.FromPlane(p));
    ends.source = source_part_;
    std::vector<PatchId> blockers;
    if (!FindTubeBlockers(scene_, ends, receiver_, pair_.source, cell.blockers, blockers)) {
      cell.settled = cell.shadowed = true;
      return;
    }
    cell.blockers = std::move(blockers);
  }
  cell.shadowed = !cell.blockers.empty();
  // The integrand is analytic without blockers, and between the events of a single blocker, since curved
  // events need edges of three polygons.
  bool analytic = !cell.shadowed;
  if (cell.shadowed) {
    Evaluate(cell, kSeven);
    analytic = cell.blockers.size() == 1 && events_.all_known &&
               std::none_of(cell.lines.begin(), cell.lines.end(), [&](std::int32_t l) {
                 return IsCastByAny(events_.lines[static_cast<std::size_t>(l)], cell.blockers);
               });
  } else {
    cell.lines.clear();
    Evaluate(cell, kFifteen);
  }
  if (analytic) {
    const auto reduced = [&](double difference) {
      const double x = kAnalyticScale * difference / cell.value;
      return cell.value > 0 ? std::min(difference, cell.value * x * std::sqrt(x)) : difference;
    };
    cell.error_s = reduced(cell.error_s);
    cell.error_t = reduced(cell.error_t);
  }
  const double noise = (cell.shadowed ? kShadowNoise : kClearNoise) * cell.value;
  double width = 0;
  for (const Vec2& p : cell.quad) width = std::max(width, (p - cell.quad[1]).norm());
  cell.settled = cell.Error() <= noise || width <= kLeastWidth * pair_.diameter;
}

// Progress of an error from `first` to `asked`, on a logarithmic scale.
double ShareOfDigits(double first, double error, double asked) {
  return asked > 0 && asked < error && error < first ? std::log(first / error) / std::log(first / asked) : 0;
}

FormFactorEstimate PairIntegral::Integrate() {
  ParallelFor(cells_.size(), 1, [&](std::size_t i) { Evaluate(cells_[i]); });
  double value = 0, error = 0, first_error = 0, share = 0;
  bool shadowed = false;
  std::size_t points = 0;
  for (const Cell& cell : cells_) points += cell.points;
  for (;;) {
    value = error = 0;
    shadowed = false;
    for (const Cell& cell : cells_) {
      value += cell.value;
      error += cell.Error();
      shadowed = shadowed || cell.shadowed;
    }
    const double asked =
        std::max(options_.sufficient_error,
                 sender_area_ * AllowedError(value / sender_area_,
                                             shadowed ? options_.tolerance : options_.clear_tolerance));
    if (error <= asked || points >= options_.max_points) break;
    if (error <= options_.small_error * sender_area_ && points >= options_.sufficient_points) break;
    if (options_.context && options_.context->Cancelled()) break;
    first_error = std::max(first_error, error);
    share = std::max(share, ShareOfDigits(first_error, error, asked));
    if (options_.context && options_.reports_progress) options_.context->Report("integrate", share);
    std::vector<std::size_t> order(cells_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t i) { return cells_[i].settled || cells_[i].Error() == 0; });
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(-cells_[a].Error(), a) < std::pair(-cells_[b].Error(), b);
    });
    if (order.empty()) break;
    double left = 0;
    for (const std::size_t i : order) left += cells_[i].Error();
    std::size_t chosen = 0;
    const double alone = std::max(kLeftAlone * left, kLeftOfAsked * asked);
    while (chosen < order.size() && (left > alone || chosen == 0)) left -= cells_[order[chosen++]].Error();
    std::vector<std::vector<Cell>> parts(chosen);
    ParallelFor(chosen, 1, [&](std::size_t k) {
      Split(cells_[order[k]], parts[k]);
      for (Cell& part : parts[k]) Evaluate(part);
    });
    for (std::size_t k = 0; k < chosen; ++k) {
      for (const Cell& part : parts[k]) points += part.points;
      cells_[order[k]] = std::move(parts[k].front());
      cells_.insert(cells_.end(), std::make_move_iterator(parts[k].begin() + 1),
                    std::make_move_iterator(parts[k].end()));
    }
  }
  // Points have the rounding errors of their coordinates. The effect on the form factor grows as the source
  // comes closer.
  const double apart = (Centroid(source_part_) - pair_.frame.FromPlane(pair_.area[0])).norm() -
                       pair_.diameter - Diameter(source_part_);
  const double nearness = std::min(1 / pair_.diameter, apart > 0 ? kFallOff / apart : 1 / pair_.diameter);
  const double rounding =
      kFormFactorError +
      kPointRoundings * std::numeric_limits<double>::epsilon() * scene_.patches[receiver_].extent * nearness +
      (shadowed ? kShadowNoise : 0);
  return {value, error + rounding * value, !shadowed, points};
}

}  // namespace

double AllowedError(double factor, double tolerance) {
  return std::max(tolerance * std::max(factor, tolerance), kLeastAllowed);
}

FormFactorEstimate IntegratePair(const Scene& scene, const PartPair& pair, std::vector<PatchId> blockers,
                                 const AreaFormFactorOptions& options) {
  return PairIntegral(scene, pair, std::move(blockers), options).Integrate();
}

}  // namespace penumbra
