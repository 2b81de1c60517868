// solver/visibility/point/image_frame.h
//
// Directions as points of a plane: great circles become lines, and cutting becomes plane geometry.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

// A line of the image as the zero of a x + b y + h, with (a, b) of unit length.
struct ImageLine {
  double a = 0, b = 0, h = 0;
};

enum class Digits { kDouble, kExtended, kQuadruple };

// A convex polygon of the image, counter-clockwise.
struct ImagePolygon {
  static constexpr int kCapacity = 36;

  int size = 0;
  std::array<double, kCapacity> x, y;

  ImagePolygon() {}  // NOLINT: the arrays stay as they are
  ImagePolygon(const ImagePolygon& other) { *this = other; }
  // Copies what is in use.
  ImagePolygon& operator=(const ImagePolygon& other) {
    size = other.size;
    std::copy_n(other.x.begin(), size, x.begin());
    std::copy_n(other.y.begin(), size, y.begin());
    return *this;
  }

  void Add(double px, double py) {
    x[static_cast<std::size_t>(size)] = px;
    y[static_cast<std::size_t>(size)] = py;
    ++size;
  }
};

// The central projection of directions onto a plane one unit from the point, with its origin at the first
// vertex of a polygon: what is small and far keeps its digits, since coordinates are differences.
class ImageFrame {
 public:
  // REQUIRES: all of the polygon within 80 degrees of the axis, as the parts of SplitForImages() are.
  ImageFrame(const DirectionPolygon& polygon, const Vec3& axis);

  // REQUIRES: the direction lies before the plane, as what the frame was made for does.
  Vec2 Image(const Vec3& direction) const {
    const double w = axis_.dot(direction);
    const Vec3 offset = direction - first_;
    // A difference keeps the digits of what is close to the first vertex, and loses those of a vertex that is
    // close to the point.
    if (offset.squaredNorm() > kNearFirstSquared * direction.squaredNorm())
      return Vec2(e1_.dot(direction), e2_.dot(direction)) / w - shift_;
    return (Vec2(e1_.dot(offset), e2_.dot(offset)) - axis_.dot(offset) * shift_) / w;
  }
  ImagePolygon Image(const DirectionPolygon& polygon) const {
    ImagePolygon image;
    for (int i = 0; i < polygon.size(); ++i) {
      const Vec2 p = Image(polygon[i]);
      image.Add(p.x(), p.y());
    }
    return image;
  }
  // The direction of an image point.
  Vec3 Direction(const Vec2& p) const { return origin_ + p.x() * e1_ + p.y() * e2_; }
  // The direction of the image's origin, and its coordinates along E1 and E2.
  const Vec3& Origin() const { return origin_; }
  const Vec2& Shift() const { return shift_; }
  const Vec3& E1() const { return e1_; }
  const Vec3& E2() const { return e2_; }
  const Vec3& Axis() const { return axis_; }

  // (x, y, w): the image point is (x/w, y/w) where w > 0; behind the point w < 0.
  Vec3 Homogeneous(const Vec3& direction) const {
    const double w = axis_.dot(direction);
    return {e1_.dot(direction) - w * shift_.x(), e2_.dot(direction) - w * shift_.y(), w};
  }

  // Plane k of a cone. The line's distance from the origin, small against the terms that it is the sum of
  // where the image is small, is worked out in so many digits.
  ImageLine Line(const Cone& cone, int k, Digits digits) const;

 private:
  // The square of a distance from the first vertex, relative to that from the point: a tenth. What lies
  // farther off loses less than a digit by not being a difference.
  static constexpr double kNearFirstSquared = 0.01;

  Vec3 axis_, e1_, e2_;
  Vec3 first_;   // the polygon's first vertex as seen
  Vec3 origin_;  // the same direction, one unit along the axis
  Vec2 shift_;   // its coordinates along e1 and e2
};

// What an edge of a piece of a source runs along. Not set at first, so that arrays of them cost nothing.
class EdgeLabel {
 public:
  EdgeLabel() = default;

  // Along nothing: two pieces of the same source meet there.
  static constexpr EdgeLabel Inner() { return EdgeLabel(kInner, 0); }
  // Along an edge of the source, from vertex `edge` to the next.
  static constexpr EdgeLabel OfSource(int edge) { return EdgeLabel(kSource, edge); }
  // Along a plane of the cone of an occluder, by its place in the list of occluders.
  static constexpr EdgeLabel OfOccluder(std::size_t occluder, int plane) {
    return EdgeLabel(static_cast<std::int32_t>(occluder), plane);
  }

  constexpr bool IsInner() const { return occluder_ == kInner; }
  constexpr bool IsOfSource() const { return occluder_ == kSource; }
  // REQUIRES: the label is of the source.
  constexpr int SourceEdge() const { return edge_; }
  // REQUIRES: the label is of an occluder.
  constexpr std::size_t Occluder() const { return static_cast<std::size_t>(occluder_); }
  constexpr std::size_t Plane() const { return static_cast<std::size_t>(edge_); }

 private:
  static constexpr std::int32_t kInner = -1, kSource = -2;
  constexpr EdgeLabel(std::int32_t occluder, std::int32_t edge) : occluder_(occluder), edge_(edge) {}

  std::int32_t occluder_, edge_;
};

// A part of a polygon of directions that fits into an image.
struct ImagePart {
  DirectionPolygon polygon;
  Vec3 axis;
  std::array<EdgeLabel, DirectionPolygon::kCapacity> label;  // of its edges
};

// The axis of an image that holds the polygon; zero if none can.
Vec3 ImageAxis(const DirectionPolygon& polygon);

// Appends the polygon, which lies above the horizon of `normal`, as one part where it fits into an image as a
// whole; else cut by two planes through the normal. What sits on the horizon all round takes four.
void SplitForImages(const DirectionPolygon& polygon, const Vec3& normal, std::vector<ImagePart>& parts);

}  // namespace penumbra
