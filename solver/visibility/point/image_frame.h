// solver/visibility/point/image_frame.h
//
// Central projection of directions onto a plane: great circles become lines, and polygons of directions
// become plane polygons.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

// A line of the image, with the equation a x + b y + h = 0, where a^2 + b^2 = 1.
struct ImageLine {
  double a = 0, b = 0, h = 0;
};

enum class Digits { kDouble, kExtended, kQuadruple };

// A convex polygon of the image, counter-clockwise.
struct ImagePolygon {
  static constexpr int kCapacity = 36;

  int size = 0;
  std::array<double, kCapacity> x, y;

  ImagePolygon() {}  // NOLINT: the arrays x and y stay uninitialised
  ImagePolygon(const ImagePolygon& other) { *this = other; }
  // The assignment copies only the vertices in use, not the whole arrays.
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

// The central projection of directions onto a plane at unit distance from the point. The image of a polygon's
// first vertex is the origin: image coordinates are differences, so that small and distant polygons lose no
// digits.
class ImageFrame {
 public:
  // REQUIRES: all directions of the polygon lie within 80 degrees of the axis, as in the parts that
  // SplitForImages() makes.
  ImageFrame(const DirectionPolygon& polygon, const Vec3& axis);

  // The image point of a direction. REQUIRES: axis . direction > 0, that is, the direction points to the
  // image plane.
  Vec2 Image(const Vec3& direction) const {
    const double w = axis_.dot(direction);
    const Vec3 offset = direction - first_;
    // For directions close to the first vertex, the formula with the difference `offset` loses no digits. For
    // directions far from the first vertex, such as those of vertices close to the point, the difference
    // `offset` itself would lose digits.
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
  // The vector from the viewpoint to the point of the image plane with the image coordinates p.
  Vec3 Direction(const Vec2& p) const { return origin_ + p.x() * e1_ + p.y() * e2_; }
  // The direction of the image's origin, and the coordinates of that direction along E1 and E2.
  const Vec3& Origin() const { return origin_; }
  const Vec2& Shift() const { return shift_; }
  const Vec3& E1() const { return e1_; }
  const Vec3& E2() const { return e2_; }
  const Vec3& Axis() const { return axis_; }

  // The homogeneous image coordinates (x, y, w) of a direction: the image point is (x/w, y/w) if w > 0.
  // Directions that point away from the image plane have w < 0.
  Vec3 Homogeneous(const Vec3& direction) const {
    const double w = axis_.dot(direction);
    return {e1_.dot(direction) - w * shift_.x(), e2_.dot(direction) - w * shift_.y(), w};
  }

  // The image of plane k of a blocker's cone. In small images, the line's distance from the origin,
  // ImageLine::h, is a small sum of large terms; `digits` is the precision with which the sum is computed.
  ImageLine Line(const Cone& cone, int k, Digits digits) const;

 private:
  // Image() computes with the difference direction - first_ if |direction - first_|^2 / |direction|^2 is at
  // most kNearFirstSquared. If |direction - first_|^2 / |direction|^2 is larger than kNearFirstSquared, image
  // coordinates that are computed from the direction itself lose less than one decimal digit.
  static constexpr double kNearFirstSquared = 0.01;

  Vec3 axis_, e1_, e2_;
  Vec3 first_;   // the direction from the viewpoint to the polygon's first vertex
  Vec3 origin_;  // the direction first_, scaled so that axis . origin_ = 1
  Vec2 shift_;   // the coordinates of the direction origin_ along the axes e1 and e2 of the image
};

// The label of an edge of a visible part of the source, which identifies the edge of the source or of a
// blocker that bounds the visible part. A default-constructed EdgeLabel is uninitialised, so that making
// arrays of labels takes no time.
class EdgeLabel {
 public:
  EdgeLabel() = default;

  // The label of a border between two pieces of the same source.
  static constexpr EdgeLabel Inner() { return EdgeLabel(kInner, 0); }
  // The label of the edge of the source from the vertex with index `edge` to the next vertex.
  static constexpr EdgeLabel OfSource(int edge) { return EdgeLabel(kSource, edge); }
  // The label of an edge in plane `plane` of the cone of an occluder; `occluder` is the index in the list of
  // occluders.
  static constexpr EdgeLabel OfOccluder(std::size_t occluder, int plane) {
    return EdgeLabel(static_cast<std::int32_t>(occluder), plane);
  }

  constexpr bool IsInner() const { return occluder_ == kInner; }
  constexpr bool IsOfSource() const { return occluder_ == kSource; }
  // REQUIRES: the label is that of an edge of the source.
  constexpr int SourceEdge() const { return edge_; }
  // REQUIRES: the label is that of an edge of an occluder.
  constexpr std::size_t Occluder() const { return static_cast<std::size_t>(occluder_); }
  constexpr std::size_t Plane() const { return static_cast<std::size_t>(edge_); }

 private:
  static constexpr std::int32_t kInner = -1, kSource = -2;
  constexpr EdgeLabel(std::int32_t occluder, std::int32_t edge) : occluder_(occluder), edge_(edge) {}

  std::int32_t occluder_, edge_;
};

// A part of a polygon of directions that fits into one image.
struct ImagePart {
  DirectionPolygon polygon;
  Vec3 axis;
  // label[k] tells from which edge of the source or of an occluder edge k of the polygon comes.
  std::array<EdgeLabel, DirectionPolygon::kCapacity> label;
};

// A projection axis for which one ImageFrame can show the whole polygon; the zero vector if no such axis
// exists.
Vec3 ImageAxis(const DirectionPolygon& polygon);

// Divides the polygon into parts that each fit into one image, and appends them to `parts`. A polygon that
// fits into one image as a whole gives one part; otherwise two planes through `normal` cut the polygon. A
// polygon that contains the whole horizon gives four parts. REQUIRES: the polygon lies above the horizon of
// `normal`.
void SplitForImages(const DirectionPolygon& polygon, const Vec3& normal, std::vector<ImagePart>& parts);

}  // namespace penumbra
