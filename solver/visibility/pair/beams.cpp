#include "solver/visibility/pair/beams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/geometry/planar_sets.h"
#include "solver/visibility/pair/tube.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {
namespace {

// Openings narrower than kCrack times the largest coordinate are closed. That is the error of the place where
// a segment crosses a wall, for segments whose length is at most kMostSlope times the height that they gain.
constexpr double kMostSlope = 64, kCrack = 4 * kMostSlope * kCoplanar;

// A wall that leaves a larger fraction of the section open is not used: its beams would overlap.
constexpr double kMostOpen = 0.6;

// Walls that hide a smaller fraction of the segments between corners are not tested.
constexpr double kLeastCorners = 0.4;

// If an opening has more pieces, their convex hull replaces them.
constexpr std::size_t kMostPieces = 3;

// If the area of the pieces' convex hull is at most this times their area, the hull replaces them.
constexpr double kNearlyConvex = 1.01;

// Number of walls to test before the current beams are taken as final.
constexpr int kMostSections = 48;

double Height(const Vec3& normal, const Vec3& on, const Vec3& p) { return normal.dot(p - on); }

struct Wall {
  Vec3 on, normal;  // a lies before the plane, b behind it
  std::vector<PatchId> parts;
};

// Clips `polygon` to the region that lines from `from` through `through` reach beyond `through`. The clipping
// planes contain an edge of one polygon and a vertex of the other, and have `from` behind and `through`
// before them. `slack` is the error of heights above these planes at `polygon` [m].
void ClipToReach(std::span<const Vec3> from, std::span<const Vec3> through, double rounding, double slack,
                 Polygon3& polygon) {
  const auto clip = [&](std::span<const Vec3> edges, std::span<const Vec3> vertices) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Vec3& p = edges[i];
      const Vec3 edge = edges[(i + 1) % edges.size()] - p;
      for (const Vec3& q : vertices) {
        Vec3 normal = edge.cross(q - p);
        const double length = normal.norm();
        if (length <= kParallel * edge.norm() * (q - p).norm()) continue;
        normal /= length;
        double from_low = 0, from_high = 0, low = 0, high = 0;
        for (const Vec3& v : from) {
          from_low = std::min(from_low, Height(normal, p, v));
          from_high = std::max(from_high, Height(normal, p, v));
        }
        if (from_low < -rounding && from_high > rounding) continue;
        for (const Vec3& v : through) {
          low = std::min(low, Height(normal, p, v));
          high = std::max(high, Height(normal, p, v));
        }
        if (from_low >= -rounding && high <= rounding && low < -rounding) {
          normal = -normal;
        } else if (!(from_high <= rounding && low >= -rounding && high > rounding)) {
          continue;
        }
        const Vec3 on = p - slack * normal;
        const bool cuts = std::any_of(polygon.begin(), polygon.end(),
                                      [&](const Vec3& v) { return Height(normal, on, v) < 0; });
        if (cuts) polygon = ClipToHalfSpace(polygon, normal, on);
        if (polygon.empty()) return;
      }
    }
  };
  clip(from, through);
  if (!polygon.empty()) clip(through, from);
}

// The points where segments between corners of the two polygons cross the wall's plane.
std::vector<Vec3> Crossings(const Wall& wall, std::span<const Vec3> before, std::span<const Vec3> behind) {
  std::vector<Vec3> points;
  points.reserve(before.size() * behind.size());
  for (const Vec3& p : before) {
    const double hp = Height(wall.normal, wall.on, p);
    for (const Vec3& q : behind) {
      const double hq = Height(wall.normal, wall.on, q);
      points.push_back(p + (q - p) * (hp / (hp - hq)));
    }
  }
  return points;
}

class BeamFinder {
 public:
  BeamFinder(const Scene& scene, std::span<const Vec3> a, std::span<const Vec3> b,
             std::span<const PatchId> blockers, bool first_only)
      : scene_(scene), first_only_(first_only) {
    for (const std::span<const Vec3> end : {a, b})
      for (const Vec3& v : end) scale_ = std::max(scale_, MaxAbs(v));
    for (const PatchId id : blockers)
      scale_ = std::max(scale_, scene.patches[static_cast<std::size_t>(id)].extent);
    rounding_ = HeightRounding(scale_);
    CollectWalls(a, b, blockers);
    Divide({{a.begin(), a.end()}, {b.begin(), b.end()}}, std::vector<char>(walls_.size(), 0));
    std::sort(found_.wall_parts.begin(), found_.wall_parts.end());
    found_.wall_parts.erase(std::unique(found_.wall_parts.begin(), found_.wall_parts.end()),
                            found_.wall_parts.end());
  }

  Beams Take() { return std::move(found_); }

 private:
  using Stations = std::vector<Polygon3>;

  void CollectWalls(std::span<const Vec3> a, std::span<const Vec3> b, std::span<const PatchId> blockers);
  bool Separates(const Wall& wall, std::span<const Vec3> before, std::span<const Vec3> behind) const;
  double CornersHidden(const Wall& wall, std::span<const Vec3> before, std::span<const Vec3> behind) const;
  bool Open(const Stations& stations, const Wall& wall, std::vector<Polygon3>& pieces) const;
  std::pair<std::size_t, std::size_t> Neighbours(const Stations& stations, const Wall& wall) const;
  void Divide(const Stations& stations, const std::vector<char>& used);
  bool Narrow(Stations& stations, const Wall& wall, Polygon3 piece) const;

  const Scene& scene_;
  bool first_only_;
  double scale_ = 0, rounding_ = 0;
  int sections_ = 0;
  std::vector<Wall> walls_;
  Beams found_;
};

void BeamFinder::CollectWalls(std::span<const Vec3> a, std::span<const Vec3> b,
                              std::span<const PatchId> blockers) {
  for (const PatchId id : blockers) {
    const Patch& patch = scene_.patches[static_cast<std::size_t>(id)];
    const bool turned = Height(patch.normal, patch.vertex[0], a[0]) < 0;
    Wall wall{patch.vertex[0], turned ? Vec3(-patch.normal) : patch.normal, {}};
    const auto known = std::find_if(walls_.begin(), walls_.end(), [&](const Wall& other) {
      for (const Vec3& v : patch.Vertices())
        if (std::abs(Height(other.normal, other.on, v)) > kCoplanar * scale_) return false;
      return true;
    });
    if (known != walls_.end()) {
      known->parts.push_back(id);
    } else if (Separates(wall, a, b)) {
      wall.parts.push_back(id);
      walls_.push_back(std::move(wall));
    }
  }
}

// True if one polygon lies before the wall's plane and the other behind it, far enough apart that the places
// where segments between them cross the plane are well defined.
bool BeamFinder::Separates(const Wall& wall, std::span<const Vec3> before,
                           std::span<const Vec3> behind) const {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, reach = 0;
  for (const Vec3& p : before) lowest = std::min(lowest, Height(wall.normal, wall.on, p));
  if (lowest <= kCoplanar * scale_) return false;
  for (const Vec3& q : behind) highest = std::max(highest, Height(wall.normal, wall.on, q));
  if (highest >= -kCoplanar * scale_) return false;
  for (const Vec3& p : before)
    for (const Vec3& q : behind) {
      const double fall = Height(wall.normal, p, q);
      reach = std::max(reach, (q - p).squaredNorm() / (fall * fall));
    }
  return reach <= kMostSlope * kMostSlope;
}

// The fraction of the segments between corners that the wall's parts cut.
double BeamFinder::CornersHidden(const Wall& wall, std::span<const Vec3> before,
                                 std::span<const Vec3> behind) const {
  const std::vector<Vec3> crossings = Crossings(wall, before, behind);
  std::size_t hidden = 0;
  for (const Vec3& p : crossings)
    hidden += std::any_of(wall.parts.begin(), wall.parts.end(), [&](PatchId id) {
      const Patch& patch = scene_.patches[static_cast<std::size_t>(id)];
      return ConvexContains(patch.Vertices(), patch.normal, p, kCrack * scale_);
    });
  return static_cast<double>(hidden) / static_cast<double>(crossings.size());
}

// Finds the pieces of the wall's section with the tube through the stations that the wall leaves open. False
// if they leave too much open for a beam.
bool BeamFinder::Open(const Stations& stations, const Wall& wall, std::vector<Polygon3>& pieces) const {
  const double crack = kCrack * scale_;
  Polygon3 section = ConvexHull(Crossings(wall, stations.front(), stations.back()), wall.normal);
  if (section.empty()) return false;
  const auto [near, far] = Neighbours(stations, wall);
  if (near != 0 || far + 1 != stations.size()) {
    const Polygon3 other = ConvexHull(Crossings(wall, stations[near], stations[far]), wall.normal);
    if (!other.empty()) section = Intersect(std::move(section), other, wall.normal, crack);
  }
  pieces.clear();
  if (section.empty()) return true;
  const double area = VectorArea(section).norm();
  pieces.push_back(std::move(section));
  std::vector<Polygon3> left;
  for (const PatchId id : wall.parts) {
    const Patch& patch = scene_.patches[static_cast<std::size_t>(id)];
    Polygon3 hole(patch.Vertices().begin(), patch.Vertices().end());
    if (patch.normal.dot(wall.normal) < 0) std::reverse(hole.begin(), hole.end());
    left.clear();
    for (const Polygon3& polygon : pieces) Subtract(polygon, hole, wall.normal, crack, left);
    std::swap(pieces, left);
    if (pieces.empty()) return true;
  }
  double open = 0;
  for (const Polygon3& polygon : pieces) open += VectorArea(polygon).norm();
  if (pieces.size() > 1) {
    std::vector<Vec3> all;
    for (const Polygon3& polygon : pieces) all.insert(all.end(), polygon.begin(), polygon.end());
    Polygon3 hull = ConvexHull(all, wall.normal);
    const double hull_area = VectorArea(hull).norm();
    if (pieces.size() > kMostPieces || hull_area <= kNearlyConvex * open) {
      open = hull_area;
      pieces.assign(1, std::move(hull));
    }
  }
  return open < kMostOpen * area;
}

// Clips all stations to the parts that see each other through the piece, and inserts the piece as a station.
// False if nothing remains.
bool BeamFinder::Narrow(Stations& stations, const Wall& wall, Polygon3 piece) const {
  const std::size_t count = stations.size();
  std::vector<char> before(count), behind(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto ahead = [&](double sign) {
      return std::all_of(stations[i].begin(), stations[i].end(), [&](const Vec3& v) {
        return sign * Height(wall.normal, wall.on, v) > kCoplanar * scale_;
      });
    };
    before[i] = ahead(1);
    behind[i] = ahead(-1);
  }
  // A plane through three corners has the rounding of each corner.
  constexpr double kPlaneRoundings = 3;
  const auto clip = [&](const Polygon3& from, Polygon3& to) {
    // Heights have the error `rounding` at the two polygons that span a plane; beyond them the error grows in
    // proportion to the distance.
    double near = std::numeric_limits<double>::infinity(), far = 0;
    for (const Vec3& v : from) near = std::min(near, std::abs(Height(wall.normal, wall.on, v)));
    for (const Vec3& v : to) far = std::max(far, std::abs(Height(wall.normal, wall.on, v)));
    const double slack = kPlaneRoundings * (rounding_ + kCoplanar * scale_) * (1 + far / near);
    ClipToReach(from, piece, rounding_, slack, to);
    return !to.empty();
  };
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < count; ++k)
      if (before[i] && behind[k] && (!clip(stations[i], stations[k]) || !clip(stations[k], stations[i])))
        return false;
  std::size_t place = 1;
  while (place + 1 < count && before[place]) ++place;
  stations.insert(stations.begin() + static_cast<std::ptrdiff_t>(place), std::move(piece));
  return true;
}

// The indices of the last station before the wall and the first station behind the wall.
std::pair<std::size_t, std::size_t> BeamFinder::Neighbours(const Stations& stations, const Wall& wall) const {
  std::size_t near = 0, far = stations.size() - 1;
  for (std::size_t i = 1; i + 1 < stations.size(); ++i) {
    if (near == i - 1 && Separates(wall, stations[i], stations.back())) near = i;
    if (near < i && Separates(wall, stations[near], stations[i])) {
      far = i;
      break;
    }
  }
  return {near, far};
}

void BeamFinder::Divide(const Stations& stations, const std::vector<char>& used) {
  if (first_only_ && !found_.beams.empty()) return;
  // Walls that hide more come first.
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (used[w] || (stations.size() > 2 && !Separates(walls_[w], stations.front(), stations.back())))
      continue;
    const auto [near, far] = Neighbours(stations, walls_[w]);
    const double hidden = CornersHidden(walls_[w], stations[near], stations[far]);
    if (hidden >= kLeastCorners) order.emplace_back(-hidden, w);
  }
  std::sort(order.begin(), order.end());
  std::vector<Polygon3> pieces;
  for (const auto& [ignored, w] : order) {
    if (sections_++ >= kMostSections) break;
    if (!Open(stations, walls_[w], pieces)) continue;
    const std::vector<PatchId>& parts = walls_[w].parts;
    found_.wall_parts.insert(found_.wall_parts.end(), parts.begin(), parts.end());
    std::vector<char> now_used = used;
    now_used[w] = 1;
    for (Polygon3& piece : pieces) {
      Stations narrowed = stations;
      if (Narrow(narrowed, walls_[w], std::move(piece))) Divide(narrowed, now_used);
    }
    return;
  }
  found_.beams.push_back({stations});
}

}  // namespace

Beams FindBeams(const Scene& scene, std::span<const Vec3> a, std::span<const Vec3> b,
                std::span<const PatchId> blockers) {
  return BeamFinder(scene, a, b, blockers, false).Take();
}

bool HiddenByWalls(const Scene& scene, std::span<const Vec3> a, std::span<const Vec3> b,
                   std::span<const PatchId> blockers) {
  return BeamFinder(scene, a, b, blockers, true).Take().hidden();
}

void KeepBlockersOfBeams(const Scene& scene, const Beams& found, std::vector<PatchId>& blockers) {
  if (found.wall_parts.empty()) return;
  std::vector<Tube> legs;
  for (const Beam& beam : found.beams)
    for (std::size_t i = 0; i + 1 < beam.stations.size(); ++i)
      legs.emplace_back(beam.stations[i], beam.stations[i + 1]);
  const auto misses = [&](PatchId id) {
    if (std::binary_search(found.wall_parts.begin(), found.wall_parts.end(), id)) return false;
    const Patch& patch = scene.patches[static_cast<std::size_t>(id)];
    return std::all_of(legs.begin(), legs.end(),
                       [&](const Tube& leg) { return leg.Misses(patch.Vertices(), patch.normal); });
  };
  std::erase_if(blockers, misses);
}

}  // namespace penumbra
