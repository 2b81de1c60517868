// solver/visibility/point/direction_polygon.h
//
// A convex polygon as seen from a point, as directions: form factor and occlusion depend on nothing else.
// Vertices are vectors from the point, of any length. Edges are arcs of great circles, shorter than pi.
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

// Bound of the rounding error of a point's height above a plane [m], for coordinates up to `extent` [m].
double HeightRounding(double extent);

// The side of the plane through `on` with unit normal `normal` on which the point lies. `extent` bounds the
// polygon's coordinates [m].
Side SideOf(const ReceiverPoint& at, const Vec3& normal, const Vec3& on, double extent);

// A convex polygon as seen from the viewpoint. The vertices run counter-clockwise about the polygon's normal;
// `from_front`: the viewpoint lies on the side of the normal. REQUIRES: the plane does not contain the
// viewpoint.
DirectionPolygon Seen(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front);

// The limit of Seen() for a polygon whose plane contains the viewpoint; only the part above the receiver's
// horizon. Empty unless the polygon contains the point. A vertex at the point is seen in the direction
// opposite to the approach; so is the midpoint of an edge through the point.
DirectionPolygon SeenInContact(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front);

// The part of a seen polygon above the receiver's horizon, n . direction >= 0. `extent` bounds the polygon's
// coordinates [m]. Vertices within rounding of the horizon count as on it. Intersections with the horizon are
// the directions n x (a x b).
DirectionPolygon ClipToHorizon(const ReceiverPoint& at, const DirectionPolygon& polygon, double extent);

// The cone of directions that a blocker fills: all directions with normal[k] . direction >= 0.
struct Cone {
  int size = 0;
  std::array<Vec3, 12> normal;     // unit
  std::array<Vec3, 12> direction;  // the blocker's vertices as seen; start of plane k
  std::array<Vec3, 12> end;        // end of plane k
  // A vertex whose distance from one of the planes is at most this lies in the plane [m]. Without this
  // tolerance, planes that coincide would cut off slivers whose edges have arbitrary directions.
  double rounding = 0;
};

// The normal a x b of the edge from a to b. Both neighbours of an edge compute it from the nearer end with
// the same operations, so that their results are opposite to the bit.
Vec3 EdgeNormal(const Vec3& a, const Vec3& b);

// The cone of a seen blocker. `extent` bounds the blocker's coordinates [m]. Two blockers that share an edge
// get normals for it that are opposite to the bit, so that no light leaks between them.
Cone MakeCone(const ReceiverPoint& at, const DirectionPolygon& blocker, double extent);

enum class Overlap { kNone, kPart, kAll };

// A cone that may hide a part of a source. The cone must stay at its address.
struct Occluder {
  const Cone* cone = nullptr;

  Occluder() = default;
  Occluder(const Cone& whole) : cone(&whole) {}
};

// Tests how the cone covers the polygon, up to rounding. May return kPart for a cone just outside the
// polygon.
Overlap Classify(const Cone& cone, const DirectionPolygon& polygon);

// The part of the polygon with plane . direction >= 0.
DirectionPolygon Above(const DirectionPolygon& polygon, const Vec3& plane);

}  // namespace penumbra
