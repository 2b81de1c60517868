#include "solver/visibility/point/solid_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "solver/scene/convex_solids.h"

namespace penumbra {
namespace {

// A point on the solid's surface: the index of a corner, or kMostCorners + the index of an edge that crosses
// the plane.
using Place = std::int32_t;

// Euler's formula bounds the number of edges. Each edge borders two sides, and each side may have one more
// edge in the plane.
constexpr std::size_t kMostEdges = kMostSides + kMostCorners - 2;
constexpr std::size_t kMostSegments = 2 * kMostEdges + kMostSides;

// The heights of the corners above the plane of `before`; zero for corners in the plane.
struct CornerHeights {
  std::array<double, kMostCorners> of_corner;

  CornerHeights(const ConvexSolid& solid, const Patch* before) {
    of_corner.fill(1);
    if (!before) return;
    const double rounding = HeightRounding(std::max(solid.extent, before->extent));
    for (std::size_t c = 0; c < solid.corners.size(); ++c) {
      const double h = before->normal.dot(solid.corners[c] - before->vertex[0]);
      of_corner[c] = std::abs(h) <= rounding ? 0 : h;
    }
  }
  double operator[](std::int32_t corner) const { return of_corner[static_cast<std::size_t>(corner)]; }
};

// Finds the sides that are seen from the front. False if they do not define what the solid hides.
bool FindFronts(const ReceiverPoint& at, const ConvexSolid& solid, std::array<bool, kMostSides>& front,
                bool& entered) {
  bool any = false, left = false;
  for (std::size_t s = 0; s < solid.sides.size(); ++s) {
    const ConvexSolid::Side& side = solid.sides[s];
    const Side where =
        SideOf(at, side.normal, solid.corners[static_cast<std::size_t>(side.corner[0])], solid.extent);
    if (where == Side::kFrontInLimit || where == Side::kBackInLimit) return false;
    front[s] = where == Side::kFront;
    any = any || front[s];
    if (side.patch != kNoPatch) continue;
    entered = entered || where == Side::kFront;
    left = left || where == Side::kBack;
  }
  return any && !(entered && left);
}

// The outline of the front-facing sides before the plane: edges that belong to only one such side.
class Outline {
 public:
  Outline(const ConvexSolid& solid, const CornerHeights& height) : solid_(solid), height_(height) {}

  void AddSide(const ConvexSolid::Side& side) {
    std::array<Place, 2 * kMostCorners> places;
    std::size_t count = 0;
    bool any_above = false;
    for (std::size_t i = 0; i < side.corner.size(); ++i) {
      const std::int32_t a = side.corner[i], b = side.corner[i + 1 == side.corner.size() ? 0 : i + 1];
      if (height_[a] >= 0) places[count++] = a;
      any_above = any_above || height_[a] > 0;
      if (height_[a] * height_[b] < 0)
        places[count++] = Crossing(side.edge[i], std::min(a, b), std::max(a, b));
    }
    if (!any_above || count < 3) return;
    for (std::size_t i = 0; i < count; ++i) AddSegment({places[i], places[i + 1 == count ? 0 : i + 1]});
  }

  // The outline, clockwise as fronts are seen. Empty if the segments do not form one loop.
  DirectionPolygon SeenFrom(const Vec3& eye) const {
    DirectionPolygon seen;
    if (count_ < 3 || count_ > static_cast<std::size_t>(DirectionPolygon::kCapacity)) return seen;
    std::array<Place, DirectionPolygon::kCapacity> loop;
    Place at = segments_[0].from;
    for (std::size_t i = 0; i < count_; ++i) {
      const auto* next = std::find_if(segments_.begin(), segments_.begin() + count_,
                                      [&](const Segment& s) { return s.from == at; });
      if (next == segments_.begin() + count_ || (i > 0 && at == segments_[0].from)) return seen;
      loop[i] = at;
      at = next->to;
    }
    for (std::size_t i = count_; i-- > 0;) seen.Add(Position(loop[i]) - eye);
    return seen;
  }

 private:
  struct Segment {
    Place from, to;
  };

  // Adds a border; two opposite borders cancel.
  void AddSegment(const Segment& segment) {
    for (std::size_t i = 0; i < count_; ++i)
      if (segments_[i].from == segment.to && segments_[i].to == segment.from) {
        segments_[i] = segments_[--count_];
        return;
      }
    segments_[count_++] = segment;
  }

  Place Crossing(std::int32_t edge, std::int32_t a, std::int32_t b) {
    const Vec3 &p = solid_.corners[static_cast<std::size_t>(a)],
               &q = solid_.corners[static_cast<std::size_t>(b)];
    crossing_[static_cast<std::size_t>(edge)] = p + (q - p) * (height_[a] / (height_[a] - height_[b]));
    return static_cast<Place>(kMostCorners) + edge;
  }

  const Vec3& Position(Place place) const {
    const auto i = static_cast<std::size_t>(place);
    return i < kMostCorners ? solid_.corners[i] : crossing_[i - kMostCorners];
  }

  const ConvexSolid& solid_;
  const CornerHeights& height_;
  std::array<Segment, kMostSegments> segments_;
  std::array<Vec3, kMostEdges> crossing_;
  std::size_t count_ = 0;
};

}  // namespace

SolidOutline SeenOutline(const ReceiverPoint& at, const ConvexSolid& solid, const Patch* before) {
  const CornerHeights height(solid, before);
  std::array<bool, kMostSides> front;
  SolidOutline seen;
  if (!FindFronts(at, solid, front, seen.entered)) return seen;
  Outline outline(solid, height);
  for (std::size_t s = 0; s < solid.sides.size(); ++s)
    if (front[s]) outline.AddSide(solid.sides[s]);
  seen.seen = outline.SeenFrom(at.position);
  return seen;
}

}  // namespace penumbra
