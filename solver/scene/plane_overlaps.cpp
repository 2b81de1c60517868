#include "solver/scene/plane_overlaps.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/base/size.h"
#include "solver/geometry/convex_clip.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

// Of an outline, what decides how near its plane is to another's.
struct Plane {
  Vec3 middle = Vec3::Zero();
  double off = 0;      // the largest distance of a corner [m]
  double width = 0;    // across its narrowest strip, at least [m]
  bool level = false;  // all corners have one coordinate in common: the digits tell this plane exactly
};

Plane PlaneOf(const Outline& outline) {
  Plane plane;
  for (const Vec3& p : outline.vertices) plane.middle += p - outline.vertices[0];
  plane.middle = outline.vertices[0] + plane.middle / static_cast<double>(outline.vertices.size());
  for (const Vec3& p : outline.vertices)
    plane.off = std::max(plane.off, std::abs(outline.normal.dot(p - plane.middle)));
  plane.width = VectorArea(outline.vertices).norm() / outline.diameter;
  for (int axis = 0; axis < 3; ++axis)
    plane.level =
        plane.level || std::all_of(outline.vertices.begin(), outline.vertices.end(),
                                   [&](const Vec3& p) { return p[axis] == outline.vertices[0][axis]; });
  return plane;
}

struct Box2 {
  Vec2 low, high;
};

Box2 BoxOf(std::span<const Vec2> polygon) {
  Box2 box{polygon[0], polygon[0]};
  for (const Vec2& p : polygon) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

// Tells of one pair of outlines after the other whether they overlap.
class OverlapTest {
 public:
  OverlapTest(const std::vector<Outline>& outlines, const PlaneTolerance& tolerance)
      : outlines_(outlines), tolerance_(tolerance) {
    for (const Outline& outline : outlines) planes_.push_back(PlaneOf(outline));
    parts_.resize(outlines.size());
  }

  // The distance of their planes where they do [m].
  std::optional<double> Overlap(std::int32_t i, std::int32_t j) {
    const Outline &a = outlines_[i], &b = outlines_[j];
    if (a.normal.dot(b.normal) <= 0) return std::nullopt;
    const Plane &p = planes_[i], &q = planes_[j];
    const Vec3& normal = p.width >= q.width ? a.normal : b.normal;
    double apart = kCoplanarTolerance * std::max(a.diameter, b.diameter) + p.off + q.off;
    if (!p.level || !q.level) apart += tolerance_.Between(normal);
    apart = std::max(apart, tolerance_.Least());
    // Planes that corners at the ends of the width carry, both off by that.
    const double turn = 2 * apart * (1 / p.width + 1 / q.width);
    if (a.normal.cross(b.normal).norm() > turn) return std::nullopt;
    return DistanceWhereCommon(i, j, normal, apart);
  }

 private:
  // Nothing if they have no part in common that is wide enough, or are farther apart there.
  std::optional<double> DistanceWhereCommon(std::int32_t i, std::int32_t j, const Vec3& normal,
                                            double apart) {
    // So many common parts tell of the planes; more are left out where outlines of very many corners
    // coincide.
    constexpr int kEnough = 64;
    const Outline &a = outlines_[i], &b = outlines_[j];
    const PlaneProjection projection(a.vertices[0], normal);
    const SnapTolerance reach = tolerance_.InPlane(projection, std::max(a.diameter, b.diameter));
    const std::vector<Vec2> flat_a = Project(projection, a.vertices),
                            flat_b = Project(projection, b.vertices);
    const Box2 box_b = BoxOf(flat_b);
    if (Apart(BoxOf(flat_a), box_b)) return std::nullopt;
    std::vector<std::pair<Box2, Polygon2>> parts_b;
    for (const Polygon3& part : PartsOf(j)) {
      Polygon2 flat = Project(projection, part);
      const Box2 box = BoxOf(flat);
      parts_b.emplace_back(box, std::move(flat));
    }
    std::optional<double> largest;
    int found = 0;
    for (const Polygon3& part : PartsOf(i)) {
      const Polygon2 part_a = Project(projection, part);
      const Box2 box_a = BoxOf(part_a);
      if (Apart(box_a, box_b)) continue;
      for (const auto& [box, part_b] : parts_b) {
        if (Apart(box_a, box)) continue;
        const Polygon2 common = IntersectConvex(part_a, part_b);
        const Strip strip = NarrowestStrip(common);
        if (strip.width <= reach.Across(strip.across)) continue;
        for (const Vec2& p : common) {
          const double distance =
              std::abs(a.normal.dot(projection.FromPlane(p) - planes_[i].middle) / a.normal.dot(normal) -
                       b.normal.dot(projection.FromPlane(p) - planes_[j].middle) / b.normal.dot(normal));
          if (!(distance <= apart)) return std::nullopt;
          largest = std::max(largest.value_or(0), distance);
        }
        if (++found == kEnough) return largest;
      }
    }
    return largest;
  }

  const std::vector<Polygon3>& PartsOf(std::int32_t i) {
    std::vector<Polygon3>& parts = parts_[i];
    if (!parts.empty()) return parts;
    const Outline& outline = outlines_[i];
    const PlaneProjection projection(outline.vertices[0], outline.normal);
    for (const Polygon2& flat : subtractor_.ConvexParts(Project(projection, outline.vertices))) {
      Polygon3& part = parts.emplace_back();
      for (const Vec2& p : flat) part.push_back(projection.FromPlane(p));
    }
    return parts;
  }

  static bool Apart(const Box2& a, const Box2& b) {
    return (a.low.array() > b.high.array()).any() || (b.low.array() > a.high.array()).any();
  }

  const std::vector<Outline>& outlines_;
  const PlaneTolerance& tolerance_;
  std::vector<Plane> planes_;
  std::vector<std::vector<Polygon3>> parts_;  // convex, of the outlines that were asked for
  RegionSubtractor subtractor_;
};

struct OutlineBox {
  Vec3 low, high;
  std::int32_t outline;
};

// Ascending along x, each wider by what counts as the same place.
std::vector<OutlineBox> BoxesOf(const std::vector<Outline>& outlines, const PlaneTolerance& tolerance) {
  std::vector<OutlineBox> boxes;
  for (std::int32_t i = 0; i < Size(outlines); ++i) {
    const Outline& outline = outlines[i];
    OutlineBox box{outline.vertices[0], outline.vertices[0], i};
    for (const Vec3& p : outline.vertices) {
      box.low = box.low.cwiseMin(p);
      box.high = box.high.cwiseMax(p);
    }
    const double margin = kCoplanarTolerance * outline.diameter + tolerance.Largest();
    box.low.array() -= margin;
    box.high.array() += margin;
    boxes.push_back(box);
  }
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const OutlineBox& a, const OutlineBox& b) { return a.low.x() < b.low.x(); });
  return boxes;
}

}  // namespace

PlaneTolerance::PlaneTolerance(const Vec3& step, double diagonal) : least_(kContactGap * diagonal) {
  // Numbers that differ by a unit are told apart.
  constexpr double kLessThanAUnit = 0.999;
  const double largest = step.norm();
  const double most = kCoarsestPlane * diagonal;
  step_ = largest > most ? Vec3(step * (most / largest)) : Vec3(kLessThanAUnit * step);
}

SnapTolerance PlaneTolerance::InPlane(const PlaneProjection& projection, double diameter) const {
  return {kCoplanarTolerance * diameter, projection.ToPlane(step_)};
}

double PlaneTolerance::Between(const Vec3& normal) const {
  // Half a unit for the corner that is tested, and twice that for the plane through rounded corners.
  constexpr double kUnits = 1.5;
  return kUnits * normal.cwiseAbs().dot(step_);
}

double PlaneTolerance::Largest() const {
  return std::max(least_, step_.norm() > 0 ? Between(step_.normalized()) : 0);
}

double LargestPlaneDistance(const Scene& scene) {
  return PlaneTolerance(scene.coordinate_step, scene.Diagonal()).Largest();
}

std::vector<Vec2> Project(const PlaneProjection& projection, std::span<const Vec3> points) {
  std::vector<Vec2> projected;
  for (const Vec3& p : points) projected.push_back(projection.ToPlane(p));
  return projected;
}

double FindOverlaps(std::vector<Outline>& outlines, std::span<const std::int32_t> rank,
                    const PlaneTolerance& tolerance) {
  OverlapTest test(outlines, tolerance);
  const std::vector<OutlineBox> boxes = BoxesOf(outlines, tolerance);
  double largest = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low.x() <= boxes[i].high.x(); ++j) {
      const OutlineBox &p = boxes[i], &q = boxes[j];
      if (p.low.y() > q.high.y() || q.low.y() > p.high.y()) continue;
      if (p.low.z() > q.high.z() || q.low.z() > p.high.z()) continue;
      const std::optional<double> distance = test.Overlap(p.outline, q.outline);
      if (!distance) continue;
      largest = std::max(largest, *distance);
      const bool p_wins = rank[p.outline] < rank[q.outline];
      outlines[p_wins ? q.outline : p.outline].winners.push_back(p_wins ? p.outline : q.outline);
    }
  for (Outline& outline : outlines) std::sort(outline.winners.begin(), outline.winners.end());
  return largest;
}

}  // namespace penumbra
