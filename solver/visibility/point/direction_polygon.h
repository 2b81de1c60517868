// solver/visibility/point/direction_polygon.h
//
// What a point sees of a convex polygon, as directions: form factor and occlusion depend on nothing else.
// Vertices are vectors from the point, of any length; edges are arcs of great circles shorter than pi.
//
// Notation: x the point, a -> b an edge as seen from x, m = a x b its normal. Vertices run so that every
// direction inside has m . direction > 0 for all edges.

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
  // Copies what is in use.
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

// On which side of a polygon's plane the viewpoint lies.
enum class Side {
  kFront,
  kBack,
  kInPlane,  // the plane contains the point and no approach tells the sides apart: the polygon has no effect
  kFrontInLimit,  // the plane contains the point, which is approached from the front
  kBackInLimit,
};

// How far the height of a point above a plane may be off by rounding, for coordinates up to `extent` [m].
double HeightRounding(double extent);

// The side of the plane through `on` with unit normal `normal`; `extent` bounds the polygon's coordinates
// [m].
Side SideOf(const ReceiverPoint& at, const Vec3& normal, const Vec3& on, double extent);

// What the viewpoint sees of a convex polygon (counter-clockwise about `normal`) whose plane does not contain
// it.
DirectionPolygon Seen(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front);

// The same in the limit, for a polygon whose plane contains the viewpoint: empty unless the point touches it.
// The part above the receiver's horizon only. A vertex at the point is seen in the direction opposite to the
// approach, and so is the middle of an edge through the point.
DirectionPolygon SeenInContact(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front);

// The part above the receiver's horizon n . direction >= 0 of what is seen of a polygon with coordinates up
// to `extent` [m]. Vertices on the horizon but for rounding lie on it. Crossings are taken as directions, n x
// (a x b).
DirectionPolygon ClipToHorizon(const ReceiverPoint& at, const DirectionPolygon& polygon, double extent);

// The cone that a blocker fills: all directions with normal[k] . direction >= 0.
struct Cone {
  int size = 0;
  std::array<Vec3, 12> normal;     // unit
  std::array<Vec3, 12> direction;  // the blocker's vertices as seen: plane k starts here
  std::array<Vec3, 12> end;        // and ends here
  // A vertex this near to one of the planes lies in it, but for rounding [m]. Planes coincide all the time,
  // and a sliver that was cut off by rounding has edges that run anywhere.
  double rounding = 0;
};

// The normal a x b of the edge from a to b. Both neighbours of an edge compute it from the same end, the
// nearer one, with the same operations: the results are opposite to the bit.
Vec3 EdgeNormal(const Vec3& a, const Vec3& b);

// The cone over what is seen of a blocker with coordinates up to `extent` [m]. Two blockers that share an
// edge get opposite normals for it, to the bit, so that no light leaks between them.
Cone MakeCone(const ReceiverPoint& at, const DirectionPolygon& blocker, double extent);

enum class Overlap { kNone, kPart, kAll };

// A cone that may hide a part of a source; it must stay where it is.
struct Occluder {
  const Cone* cone = nullptr;

  Occluder() = default;
  Occluder(const Cone& whole) : cone(&whole) {}
};

// How the cone covers the polygon, but for rounding. kPart may be returned for a cone just beside it.
Overlap Classify(const Cone& cone, const DirectionPolygon& polygon);

// The part of the polygon where plane . direction >= 0.
DirectionPolygon Above(const DirectionPolygon& polygon, const Vec3& plane);

}  // namespace penumbra
