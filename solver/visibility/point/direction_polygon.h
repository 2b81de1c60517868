// solver/visibility/point/direction_polygon.h
//
// A convex polygon as seen from a point, represented by directions: form factor and occlusion depend only on
// the directions. Vertices are vectors from the point, of any length. Edges are arcs of great circles,
// shorter than pi.
//
// Notation: x is the point, a -> b an edge as seen from x, m = a x b the normal of the edge. The order of the
// vertices is such that m . direction > 0 for all edges and every direction inside.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "solver/base/check.h"
#include "solver/geometry/vec.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

class DirectionPolygon {
 public:
  static constexpr int kCapacity = 20;

  DirectionPolygon() = default;
  // Copies only the vertices in use.
  DirectionPolygon(const DirectionPolygon& other) { *this = other; }
  DirectionPolygon& operator=(const DirectionPolygon& other) {
    size_ = other.size_;
    std::copy_n(other.vertex_.begin(), size_, vertex_.begin());
    return *this;
  }

  int size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }
  const Vec3& operator[](int i) const { return vertex_[static_cast<std::size_t>(i)]; }
  const Vec3& Next(int i) const { return vertex_[static_cast<std::size_t>(i + 1 == size_ ? 0 : i + 1)]; }
  void Add(const Vec3& direction) {
    PENUMBRA_CHECK(size_ < kCapacity);
    vertex_[static_cast<std::size_t>(size_++)] = direction;
  }

 private:
  std::array<Vec3, kCapacity> vertex_;
  int size_ = 0;
};

// The side of a polygon's plane on which the viewpoint lies.
enum class Side {
  kFront,
  kBack,
  kInPlane,  // the plane contains the point, which has no approach off the plane: the polygon has no effect
  kFrontInLimit,  // the plane contains the point; the approach is from the front
  kBackInLimit,
};

// A bound of the rounding error of a point's height above a plane [m], for coordinates up to `extent` [m].
double HeightRounding(double extent);

// The side of the plane through `on` with unit normal `normal` on which the point lies. `extent` bounds the
// polygon's coordinates [m].
Side SideOf(const ReceiverPoint& at, const Vec3& normal, const Vec3& on, double extent);

// A convex polygon as seen from the viewpoint. The vertices of `polygon` are counter-clockwise about the
// polygon's normal; `from_front` is true if the viewpoint lies on the side to which the normal points.
// REQUIRES: the plane does not contain the viewpoint.
DirectionPolygon Seen(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front);

// The limit of Seen() for a polygon whose plane contains the viewpoint, clipped to the part above the
// receiver's horizon. The result is empty unless the polygon contains the viewpoint. If a vertex of the
// polygon, or an interior point of one of its edges, coincides with the viewpoint, the direction of this
// vertex or edge point is -approach.
DirectionPolygon SeenInContact(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front);

// The part of a seen polygon above the receiver's horizon, n . direction >= 0. `extent` bounds the polygon's
// coordinates [m]. Vertices whose distance from the horizon is below the rounding error count as lying on the
// horizon. Intersections with the horizon are the directions n x (a x b).
DirectionPolygon ClipToHorizon(const ReceiverPoint& at, const DirectionPolygon& polygon, double extent);

// The cone of directions that a blocker fills: all directions with normal[k] . direction >= 0.
struct Cone {
  int size = 0;
  std::array<Vec3, 12> normal;     // unit
  std::array<Vec3, 12> direction;  // the blocker's vertices as seen; start of plane k
  std::array<Vec3, 12> end;        // end of plane k
  // A vertex whose distance from one of the planes is at most `rounding` [m] counts as lying in the plane.
  // Without the tolerance `rounding`, planes that coincide would cut off slivers whose edges have arbitrary
  // directions.
  double rounding = 0;
};

// The normal a x b of the edge from a to b. EdgeNormal(b, a) is exactly -EdgeNormal(a, b): both calls start
// at the nearer of the points a and b and use the same operations.
Vec3 EdgeNormal(const Vec3& a, const Vec3& b);

// The cone of a seen blocker. `extent` bounds the blocker's coordinates [m]. The normals that two adjacent
// blockers compute for their common edge are exact opposites, so that no light leaks between the blockers.
Cone MakeCone(const ReceiverPoint& at, const DirectionPolygon& blocker, double extent);

enum class Overlap { kNone, kPart, kAll };

// A cone that may hide a part of a source. The object holds only a pointer to the cone.
struct Occluder {
  const Cone* cone = nullptr;

  Occluder() = default;
  Occluder(const Cone& whole) : cone(&whole) {}
};

// Tests whether the cone covers the polygon completely, in part or not at all, up to rounding. The result may
// be kPart for a cone just outside the polygon.
Overlap Classify(const Cone& cone, const DirectionPolygon& polygon);

// The part of the polygon with plane . direction >= 0.
DirectionPolygon Above(const DirectionPolygon& polygon, const Vec3& plane);

}  // namespace penumbra
