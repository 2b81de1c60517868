// solver/visibility/point/direction_polygon.h
//
// A convex polygon as seen from a point, represented by directions: form factor and occlusion depend only on
// the directions. The vertices of the polygon are vectors of any length from the point. The edges of the
// polygon are arcs of great circles, shorter than pi.
//
// Notation: x is the viewpoint, a -> b an edge of a polygon as seen from x, m = a x b the normal of the edge.
// The order of the vertices is such that (a x b) . d > 0 for every edge a -> b and for every direction d
// inside the polygon.

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
  // The copy constructor copies only the vertices in use, not the whole array.
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
  // The plane contains the viewpoint, whose approach direction lies in the plane or is zero: the polygon has
  // no effect.
  kInPlane,
  kFrontInLimit,  // the plane contains the viewpoint, which is approached from the front of the polygon
  kBackInLimit,
};

// A bound of the rounding error of the computed height of a point above a plane [m], for coordinates of
// absolute value up to `extent` [m].
double HeightRounding(double extent);

// The side of the plane through `on` with unit normal `normal` on which the point `at` lies. `extent` is the
// largest absolute coordinate of the polygon that defines the plane [m].
Side SideOf(const ReceiverPoint& at, const Vec3& normal, const Vec3& on, double extent);

// Returns a convex polygon as seen from the viewpoint `at`. The vertices of `polygon` are counter-clockwise
// about the polygon's normal; `from_front` is true if the viewpoint lies on the side to which this normal
// points. REQUIRES: the polygon's plane does not contain the viewpoint.
DirectionPolygon Seen(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front);

// The one-sided limit of Seen() for a polygon whose plane contains the viewpoint, clipped to the part above
// the receiver's horizon. The result of SeenInContact() is empty unless the polygon contains the viewpoint.
// If the viewpoint coincides with a vertex or with a point of an edge, the direction to this vertex or point
// is -approach.
DirectionPolygon SeenInContact(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front);

// The part of a polygon of directions above the receiver's horizon, n . direction >= 0, where n is the
// receiver's normal. `extent` is the largest absolute coordinate of the polygon [m]. Vertices whose distance
// from the horizon is below the rounding error count as lying on the horizon. An edge a -> b intersects the
// horizon in the direction n x (a x b).
DirectionPolygon ClipToHorizon(const ReceiverPoint& at, const DirectionPolygon& polygon, double extent);

// The cone of directions that a blocker fills as seen from a point: all directions d with normal[k] . d >= 0
// for all k.
struct Cone {
  int size = 0;
  std::array<Vec3, 12> normal;  // the unit normals of the planes that bound the cone
  // Directions to the blocker's vertices; plane k of the cone contains direction[k] and end[k].
  std::array<Vec3, 12> direction;
  std::array<Vec3, 12> end;  // end[k] is the direction to the vertex after vertex k of the blocker
  // A vertex whose distance from a plane of the cone is at most `rounding` [m] counts as lying in the plane.
  // Without a tolerance for rounding errors, coincident planes of cones would cut off slivers whose edges
  // have arbitrary directions.
  double rounding = 0;
};

// The normal a x b of the edge from a to b. EdgeNormal(b, a) is exactly -EdgeNormal(a, b), because exchanging
// the arguments changes only the sign of the rounded result.
Vec3 EdgeNormal(const Vec3& a, const Vec3& b);

// The cone of directions that the polygon `blocker` fills. `extent` is the largest absolute coordinate of the
// blocker [m]. The normals that two adjacent blockers compute for their common edge are exact opposites, so
// that no light leaks between the blockers.
Cone MakeCone(const ReceiverPoint& at, const DirectionPolygon& blocker, double extent);

enum class Overlap { kNone, kPart, kAll };

// An occluder: the cone of a blocker that may hide a part of a source. An Occluder holds only a pointer to
// the cone.
struct Occluder {
  const Cone* cone = nullptr;

  Occluder() = default;
  Occluder(const Cone& whole) : cone(&whole) {}
};

// Tests whether the cone covers the polygon completely (kAll), in part (kPart) or not at all (kNone), up to
// rounding. For a cone just outside the polygon, Classify() may return kPart.
Overlap Classify(const Cone& cone, const DirectionPolygon& polygon);

// The part of a polygon of directions in which plane . direction >= 0.
DirectionPolygon Above(const DirectionPolygon& polygon, const Vec3& plane);

}  // namespace penumbra
