// solver/visibility/exact/exact_image.h
//
// The image of a source and its occluders as seen from a point: a plane figure in exact numbers, the common
// basis of backprojection and vertex tracing. Coincidences of the input (shared corners, shared edges, three
// edges through a point) remain exact coincidences of the image, and near coincidences become exact slivers.
// The exact image is computed without tolerances.
//
// The class ExactImage is a template over the CGAL kernel, so that only source files include CGAL.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/base/check.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

// The image point of a direction d is (d_i / (axis . d) - origin.x, d_j / (axis . d) - origin.y). The
// projection onto the image plane keeps orientation: a DirectionPolygon that is counter-clockwise about its
// interior has a counter-clockwise image.
struct ImagePlane {
  Vec3 axis = Vec3::UnitZ();
  int i = 0, j = 1, k = 2;
  Vec2 origin = Vec2::Zero();

  // Makes the image plane axis . p = 1 with axis = along. The image coordinates i and j are the two
  // coordinate axes that are most nearly perpendicular to `along`.
  explicit ImagePlane(const Vec3& along) : axis(along) {
    axis.cwiseAbs().maxCoeff(&k);
    i = (k + 1) % 3;
    j = (k + 2) % 3;
    if (axis[k] < 0) std::swap(i, j);
  }

  Vec3 Base() const {
    Vec3 base;
    base[i] = origin.x();
    base[j] = origin.y();
    base[k] = (1 - axis[i] * origin.x() - axis[j] * origin.y()) / axis[k];
    return base;
  }
  // Converts a vector of image coordinates to the corresponding vector in space, which is parallel to the
  // image plane. Base() + Lift(p) is the direction of image point p.
  Vec3 Lift(const Vec2& vector) const {
    Vec3 lifted;
    lifted[i] = vector.x();
    lifted[j] = vector.y();
    lifted[k] = -(axis[i] * vector.x() + axis[j] * vector.y()) / axis[k];
    return lifted;
  }
};

// A box of doubles that contains an exact point or figure.
struct ImageBox {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());

  bool Meets(const ImageBox& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

// The owner of an image edge: the source or the occluder to whose outline the edge belongs.
class EdgeOwner {
 public:
  // The owner of edges of the source's outline.
  static constexpr EdgeOwner Source() { return EdgeOwner(kSource); }
  // The owner of borders between two parts of one occluder, which belong to no outline.
  static constexpr EdgeOwner Diagonal() { return EdgeOwner(kDiagonal); }
  // The owner of edges of an occluder's outline; `occluder` is the index in the list of occluders.
  static constexpr EdgeOwner Occluder(std::int32_t occluder) { return EdgeOwner(occluder); }

  constexpr bool IsOccluder() const { return code_ >= 0; }
  // The index of the occluder that owns the edge. REQUIRES: the owner is an occluder.
  constexpr std::int32_t OccluderNumber() const { return code_; }
  constexpr bool operator==(const EdgeOwner&) const = default;

 private:
  static constexpr std::int32_t kSource = -1, kDiagonal = -2;
  constexpr explicit EdgeOwner(std::int32_t code) : code_(code) {}

  std::int32_t code_;
};

template <class Kernel>
class ExactImage {
 public:
  using Number = typename Kernel::FT;
  using Point = typename Kernel::Point_2;
  using Line = typename Kernel::Line_2;

  // A direction in homogeneous coordinates: the image point of the direction is (x / w, y / w). Directions
  // that point away from the image plane have w < 0.
  struct Homogeneous {
    Number x, y, w;
    // For a corner of an outline: true if the edge that starts at the corner is a diagonal, not an edge of
    // the outline.
    bool diagonal = false;
  };

  // An edge, in the image, of the outline of the source or of an occluder.
  struct Edge {
    Line line;  // the line that contains the edge; the interior of the outline is on its positive side
    EdgeOwner owner = EdgeOwner::Source();
    // True if a part of the occluder's edge lies within the image of the source.
    bool seen = false;
    // The indices of the points at the ends of that part of the edge that lies within the source's image.
    std::size_t from = 0, to = 0;
  };

  // The outline of a convex region, bounded by the lines of edges[first] to edges[last - 1].
  struct Outline {
    std::int32_t first = 0, last = 0;
    ImageBox box;
  };

  // A place: an image point at which one or more corners and edges coincide.
  struct Place {
    Point point;
    ImageBox box;
    Vec2 offset = Vec2::Zero();  // the exact coordinates of the point in the image, rounded to doubles
  };

  // Makes the image of a source, or of a part of a source, whose vertices all satisfy axis . vertex > 0.
  // Edges of occluders' outlines that are shorter than min_segment * (diameter of the source) are collapsed.
  ExactImage(const ImagePlane& plane, std::span<const std::array<Number, 3>> source,
             std::span<const Occluder> occluders, double min_segment)
      : plane_(plane) {
    if (!ImageSource(source)) return;
    for (std::size_t o = 0; o < occluders.size(); ++o)
      ImageOccluder(*occluders[o].cone, static_cast<std::int32_t>(o), min_segment);
    FindPlaces();
  }

  // Divides the source into parts, and calls body(image) with the image of each part. A source that fills a
  // hemisphere may need four images.
  template <class Body>
  static void ForEachPart(const DirectionPolygon& source, std::span<const Occluder> occluders,
                          const Vec3& normal, double min_segment, const Body& body);

  static constexpr double kNormalError = 5e-16;

  bool empty() const { return source_.last == 0; }
  const ImagePlane& plane() const { return plane_; }
  // The list edges() holds the edges of the source's outline first, then the edges of the occluders'
  // outlines. Occluders that lie completely on the outer side of one edge of the source are omitted.
  const Outline& source() const { return source_; }
  const std::vector<Outline>& occluders() const { return occluders_; }
  const std::vector<Edge>& edges() const { return edges_; }
  // The normal of the plane that contains the viewpoint and the image line `line`; the normal points to the
  // positive side of the line. The error of each coordinate of the normal is at most kNormalError * (sum of
  // the absolute values of the line's coefficients).
  Vec3 NormalOf(const Line& line) const {
    const Number a = line.a(), b = line.b(), c = line.c() - a * plane_.origin.x() - b * plane_.origin.y();
    constexpr double kAny = std::numeric_limits<double>::infinity();
    const double accuracy = kNormalError * (std::abs(ToDouble(a, kAny)) + std::abs(ToDouble(b, kAny)) +
                                            std::abs(ToDouble(c, kAny)));
    Vec3 normal = ToDouble(c, accuracy) * plane_.axis;
    normal[plane_.i] = ToDouble(a + c * plane_.axis[plane_.i], accuracy);
    normal[plane_.j] = ToDouble(b + c * plane_.axis[plane_.j], accuracy);
    return normal;
  }
  // The places of the image: the corners of the source, the corners of occluders inside the source, and the
  // crossings of edges. Because the places are in lexicographic order of (x, y), the indices of the places on
  // a line are monotonic along the line.
  const std::vector<Place>& places() const { return places_; }
  // The indices, in ascending order, of the places (corners and crossings) on the part of an edge that lies
  // in the source.
  const std::vector<std::int32_t>& PlacesOn(std::int32_t edge) const {
    return on_edge_[static_cast<std::size_t>(edge)];
  }

  // A bound of the error of each coordinate of Place::offset, the position of a place rounded to doubles.
  double offset_error() const { return kOffsetAccuracy * diameter_; }

  // The side of an edge's line on which a place (corner or crossing) lies: 1 inside the outline of the edge,
  // -1 outside, 0 on the line.
  int SideOf(std::int32_t edge, std::int32_t place) const {
    const std::vector<std::int32_t>& on = PlacesOn(edge);
    if (std::binary_search(on.begin(), on.end(), place)) return 0;
    return edges_[static_cast<std::size_t>(edge)].line.oriented_side(
        places_[static_cast<std::size_t>(place)].point);
  }

  // Converts an exact number to a double with an error of at most max(accuracy, kLastDigits * |number|).
  static double ToDouble(const Number& number, double accuracy) {
    auto [low, high] = to_interval(number);
    if (high - low > std::max(2 * accuracy, kLastDigits * std::abs(low + high))) {
      number.exact();
      std::tie(low, high) = to_interval(number);
    }
    return 0.5 * (low + high);
  }

 private:
  // The accuracy of image coordinates for the comparison of lengths, equal to the rounding error of numbers
  // near 1, because the size of the image is about 1.
  static constexpr double kPlaceAccuracy = 1e-16;
  static constexpr double kLastDigits = 2 * std::numeric_limits<double>::epsilon();

  static constexpr std::size_t kNoPoint = std::numeric_limits<std::size_t>::max();

  // A bound of (error of Place::offset) / (diameter of the source). The kernel's interval arithmetic usually
  // reaches the accuracy kOffsetAccuracy; otherwise, ToDouble() computes the exact number.
  static constexpr double kOffsetAccuracy = 2e-15;

  // If the diameter of the source's image is below kSmallSource, lines and points are evaluated exactly as
  // soon as they are made. For crossings of exactly evaluated lines, the intervals of the CGAL kernel are
  // narrow enough, so that these crossings need no exact evaluation.
  static constexpr double kSmallSource = 0.03;

  static Homogeneous Cross(const Homogeneous& a, const Homogeneous& b) {
    return {a.y * b.w - a.w * b.y, a.w * b.x - a.x * b.w, a.x * b.y - a.y * b.x};
  }
  static Number Dot(const Homogeneous& a, const Homogeneous& b) { return a.x * b.x + a.y * b.y + a.w * b.w; }

  Line LineThrough(const Homogeneous& a, const Homogeneous& b) const {
    const Homogeneous c = Cross(a, b);
    if (diameter_ < kSmallSource) c.x.exact(), c.y.exact(), c.w.exact();
    return Line(c.x, c.y, c.w);
  }
  static Number Height(const Line& line, const Homogeneous& h) {
    return line.a() * h.x + line.b() * h.y + line.c() * h.w;
  }

  Homogeneous ToImage(const Number& di, const Number& dj, const Number& dk) const {
    Number w = dk * plane_.axis[plane_.k];
    if (plane_.axis[plane_.i] != 0) w += di * plane_.axis[plane_.i];
    if (plane_.axis[plane_.j] != 0) w += dj * plane_.axis[plane_.j];
    return {di - w * plane_.origin.x(), dj - w * plane_.origin.y(), w};
  }
  Homogeneous ToImage(const Vec3& d) const { return ToImage(d[plane_.i], d[plane_.j], d[plane_.k]); }

  static ImageBox BoxOf(const Point& point) {
    const auto box = point.bbox();
    return {{box.xmin(), box.ymin()}, {box.xmax(), box.ymax()}};
  }
  static ImageBox Join(const ImageBox& a, const ImageBox& b) {
    return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
  }

  std::size_t AddPoint(const Point& point) {
    if (diameter_ < kSmallSource) point.exact();
    point_.push_back(point);
    return point_.size() - 1;
  }

  static Point Crossing(const Line& a, const Line& b) {
    const auto meeting = intersection(a, b);
    PENUMBRA_CHECK(meeting);
    const Point* point = get<Point>(&*meeting);
    PENUMBRA_CHECK(point);
    return *point;
  }

  // Adds the convex hull of the source to the image. The hull differs from the source's polygon only because
  // vertices are rounded. Returns false if the convex hull of the source has no interior.
  bool ImageSource(std::span<const std::array<Number, 3>> source);
  void ImageOccluder(const Cone& cone, std::int32_t number, double min_segment);
  void AddOccluder(std::span<const Homogeneous> outline, std::int32_t number);
  using Directions = std::vector<std::array<Number, 3>>;
  static Directions PartBefore(const Directions& polygon, const Vec3& plane,
                               const std::array<Number, 3>& zenith);
  void CollapseShort(double length, std::vector<Homogeneous>& outline) const;
  void ClipToSource(const Homogeneous& a, const Homogeneous& b, Edge& edge, std::size_t& point_a,
                    std::size_t& point_b);

  // An Incidence states that the point with the index `point` lies on the edge with the index `edge`.
  struct Incidence {
    std::size_t point;
    std::int32_t edge;
  };
  void Meet(std::int32_t a, std::int32_t b);
  void FindPlaces();

  ImagePlane plane_;
  double diameter_ = 0;
  // The end points and the crossings of edges in the image; several points may coincide.
  std::vector<Point> point_;
  std::vector<Incidence> incidence_;
  Outline source_;
  std::vector<Outline> occluders_;
  std::vector<Edge> edges_;
  std::vector<Place> places_;
  std::vector<std::vector<std::int32_t>> on_edge_;
};

template <class Kernel>
bool ExactImage<Kernel>::ImageSource(std::span<const std::array<Number, 3>> source) {
  const auto coordinate = [&](const std::array<Number, 3>& d, int i) {
    return d[static_cast<std::size_t>(i)];
  };
  const auto image = [&](const std::array<Number, 3>& d) {
    return ToImage(coordinate(d, plane_.i), coordinate(d, plane_.j), coordinate(d, plane_.k));
  };
  // The origin of the image is close to the first vertex of the source, so that small distant sources lose no
  // digits.
  const Homogeneous first = image(source[0]);
  plane_.origin = {ToDouble(first.x / first.w, 1), ToDouble(first.y / first.w, 1)};

  std::vector<Point> points;
  for (const std::array<Number, 3>& d : source) {
    const Homogeneous h = image(d);
    points.emplace_back(h.x / h.w, h.y / h.w);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const Point& p : points)
    diameter_ = std::max({diameter_, std::abs(p.bbox().xmax()), std::abs(p.bbox().xmin()),
                          std::abs(p.bbox().ymax()), std::abs(p.bbox().ymin())});
  if (points.size() < 3) return false;

  // Computes the lower and then the upper half of the convex hull.
  std::vector<Point> hull;
  const auto extend = [&](const Point& p, std::size_t least) {
    while (hull.size() > least && !left_turn(hull[hull.size() - 2], hull.back(), p)) hull.pop_back();
    hull.push_back(p);
  };
  for (const Point& p : points) extend(p, 1);
  const std::size_t lower = hull.size();
  for (std::size_t k = points.size() - 1; k-- > 0;) extend(points[k], lower);
  hull.pop_back();
  if (hull.size() < 3) return false;

  for (const Point& p : hull) AddPoint(p);
  for (std::size_t k = 0; k < hull.size(); ++k) {
    Edge& edge = edges_.emplace_back();
    edge.from = k;
    edge.to = k + 1 == hull.size() ? 0 : k + 1;
    edge.line = Line(hull[edge.from], hull[edge.to]);
    if (diameter_ < kSmallSource) edge.line.exact();
    edge.seen = true;
    source_.box = Join(source_.box, BoxOf(hull[k]));
  }
  source_.last = static_cast<std::int32_t>(edges_.size());
  return true;
}

// Replaces both ends of each edge shorter than `length` by the midpoint of the edge; the outline stays
// convex.
template <class Kernel>
void ExactImage<Kernel>::CollapseShort(double length, std::vector<Homogeneous>& outline) const {
  const auto at = [&](const Homogeneous& h) {
    return Vec2(ToDouble(h.x / h.w, kPlaceAccuracy), ToDouble(h.y / h.w, kPlaceAccuracy));
  };
  for (std::size_t k = 0; k < outline.size() && outline.size() >= 3;) {
    const std::size_t next = k + 1 == outline.size() ? 0 : k + 1;
    const Homogeneous &a = outline[k], &b = outline[next];
    if (a.w > 0 && b.w > 0 && plane_.Lift(at(a) - at(b)).norm() < length) {
      outline[k] = {a.x * b.w + b.x * a.w, a.y * b.w + b.y * a.w, 2 * a.w * b.w};
      outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(next));
      if (next < k) --k;
    } else {
      ++k;
    }
  }
}

template <class Kernel>
void ExactImage<Kernel>::ImageOccluder(const Cone& cone, std::int32_t number, double min_segment) {
  std::vector<Homogeneous> outline;
  std::vector<Vec3> direction(cone.direction.begin(), cone.direction.begin() + cone.size);
  for (const Vec3& d : direction) outline.push_back(ToImage(d));

  // Removes corners of the occluder's outline that rounding has turned inwards, because the plane of a short
  // edge could otherwise cut the occluder's cone in two. At long edges of the outline, corners that rounding
  // has turned inwards do no harm.
  for (std::size_t k = 0; k < outline.size() && outline.size() >= 3;) {
    const std::size_t n = outline.size(), before = (k + n - 1) % n, after = (k + 1) % n;
    if (direction[before].dot(direction[after]) > 0 &&
        Dot(Cross(outline[before], outline[k]), outline[after]) < 0) {
      outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(k));
      direction.erase(direction.begin() + static_cast<std::ptrdiff_t>(k));
      k = k >= 2 ? k - 2 : 0;
    } else {
      ++k;
    }
  }
  if (min_segment > 0) {
    double longest = 0;
    for (const Point& p : point_)
      for (const Point& q : point_)
        longest = std::max(
            longest,
            plane_.Lift({ToDouble(p.x() - q.x(), kPlaceAccuracy), ToDouble(p.y() - q.y(), kPlaceAccuracy)})
                .norm());
    CollapseShort(min_segment * longest, outline);
  }
  AddOccluder(outline, number);
}

template <class Kernel>
void ExactImage<Kernel>::AddOccluder(std::span<const Homogeneous> outline, std::int32_t number) {
  const std::size_t n = outline.size();
  if (n < 3 || (n == 3 && Dot(Cross(outline[0], outline[1]), outline[2]) <= 0)) return;
  // If three directions of an outline lie nearly on a half circle, and rounding has turned one corner
  // inwards, the outline is divided into two convex halves.
  for (std::size_t k = 0; k < n && n > 3; ++k) {
    const std::size_t before = (k + n - 1) % n, after = (k + 1) % n;
    if (Dot(Cross(outline[before], outline[k]), outline[after]) >= 0) continue;
    std::vector<Homogeneous> half;
    const std::size_t across = n / 2;
    for (std::size_t m = 0; m <= across; ++m) half.push_back(outline[(k + m) % n]);
    half.back().diagonal = true;
    AddOccluder(half, number);
    half.clear();
    for (std::size_t m = across; m <= n; ++m) half.push_back(outline[(k + m) % n]);
    half.back().diagonal = true;
    AddOccluder(half, number);
    return;
  }

  // An occluder that lies completely on the outer side of an edge of the source hides nothing.
  for (std::int32_t s = source_.first; s < source_.last; ++s) {
    const Line& line = edges_[static_cast<std::size_t>(s)].line;
    if (std::none_of(outline.begin(), outline.end(),
                     [&](const Homogeneous& h) { return Height(line, h) > 0; }))
      return;
  }

  Outline& region = occluders_.emplace_back();
  region.first = static_cast<std::int32_t>(edges_.size());
  std::vector<std::size_t> corner_point(n, kNoPoint);
  bool before = true;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Homogeneous &a = outline[k], &b = outline[k + 1 == outline.size() ? 0 : k + 1];
    Edge edge;
    edge.owner = a.diagonal ? EdgeOwner::Diagonal() : EdgeOwner::Occluder(number);
    edge.line = LineThrough(a, b);
    if (!edge.line.is_degenerate()) {
      edges_.push_back(edge);
      ClipToSource(a, b, edges_.back(), corner_point[k], corner_point[k + 1 == n ? 0 : k + 1]);
    }
    before = before && a.w > 0;
    if (before) region.box = Join(region.box, BoxOf(Point(a.x / a.w, a.y / a.w)));
  }
  region.last = static_cast<std::int32_t>(edges_.size());
  if (!before) region.box = source_.box;
}

// Finds the part of `edge`, the last edge in the list edges_, that lies in the image of the source. The edge
// runs from `a` to `b`. Neighbouring edges share the point of their common corner.
template <class Kernel>
void ExactImage<Kernel>::ClipToSource(const Homogeneous& a, const Homogeneous& b, Edge& edge,
                                      std::size_t& point_a, std::size_t& point_b) {
  struct End {
    Homogeneous at;
    std::int32_t cut = -1;  // index of the edge of the source's outline that cuts off the end; -1 if none
    std::vector<std::int32_t> on;  // the indices of the edges of the source's outline on which the point lies
  };
  End from, to;
  from.at = a;
  to.at = b;
  std::int32_t along = -1;
  for (std::int32_t s = source_.first; s < source_.last; ++s) {
    const Line& line = edges_[static_cast<std::size_t>(s)].line;
    const Number hf = Height(line, from.at), ht = Height(line, to.at);
    if (hf <= 0 && ht <= 0) {
      if (hf < 0 || ht < 0) return;
      along = s;
      continue;
    }
    if (hf == 0) from.on.push_back(s);
    if (ht == 0) to.on.push_back(s);
    if (hf >= 0 && ht >= 0) continue;
    const Number wf = hf < 0 ? ht : -ht, wt = hf < 0 ? -hf : hf;
    End& cut = hf < 0 ? from : to;
    cut.at = {wf * from.at.x + wt * to.at.x, wf * from.at.y + wt * to.at.y, wf * from.at.w + wt * to.at.w};
    cut.cut = s;
    cut.on.assign(1, s);
  }
  const auto number = static_cast<std::int32_t>(edges_.size()) - 1;
  const auto add = [&](const End& end, std::size_t& corner) {
    if (end.cut < 0 && corner != kNoPoint) return corner;
    const std::size_t point =
        AddPoint(end.cut < 0 ? Point(end.at.x / end.at.w, end.at.y / end.at.w)
                             : Crossing(edge.line, edges_[static_cast<std::size_t>(end.cut)].line));
    if (end.cut < 0) corner = point;
    for (const std::int32_t s : end.on) incidence_.push_back({point, s});
    return point;
  };
  edge.from = add(from, point_a);
  edge.to = add(to, point_b);
  // If both ends of an edge lie on the source's outline, the edge may touch the source only in a corner.
  edge.seen = from.on.empty() || to.on.empty() || point_[edge.from] != point_[edge.to];
  if (along >= 0) Meet(number, along);
}

// Finds the common points of two edges inside the source, except points that are end points of both edges.
template <class Kernel>
void ExactImage<Kernel>::Meet(std::int32_t ia, std::int32_t ib) {
  const Edge &a = edges_[static_cast<std::size_t>(ia)], &b = edges_[static_cast<std::size_t>(ib)];
  const auto side = [&](const Edge& e, std::size_t p) { return e.line.oriented_side(point_[p]); };
  const auto sa = side(a, b.from), ta = side(a, b.to);
  if (sa == ta && sa != 0) return;
  const auto sb = side(b, a.from), tb = side(b, a.to);
  if (sb == tb && sb != 0) return;
  const auto add_between = [&](std::size_t p, const Edge& e, std::int32_t edge) {
    const Point &at = point_[p], &from = point_[e.from], &to = point_[e.to];
    if ((from < at && at < to) || (to < at && at < from)) incidence_.push_back({p, edge});
  };
  if (sa == 0) add_between(b.from, a, ia);
  if (ta == 0) add_between(b.to, a, ia);
  if (sb == 0) add_between(a.from, b, ib);
  if (tb == 0) add_between(a.to, b, ib);
  if (sa == 0 || ta == 0 || sb == 0 || tb == 0) return;
  point_.push_back(Crossing(a.line, b.line));
  incidence_.push_back({point_.size() - 1, ia});
  incidence_.push_back({point_.size() - 1, ib});
}

template <class Kernel>
void ExactImage<Kernel>::FindPlaces() {
  struct Box {
    ImageBox box;
    std::int32_t edge, outline;
  };
  std::vector<Box> boxes;
  for (std::int32_t e = 0; e < source_.last; ++e) {
    incidence_.push_back({edges_[static_cast<std::size_t>(e)].from, e});
    incidence_.push_back({edges_[static_cast<std::size_t>(e)].to, e});
  }
  for (std::size_t o = 0; o < occluders_.size(); ++o)
    for (std::int32_t e = occluders_[o].first; e < occluders_[o].last; ++e) {
      const Edge& edge = edges_[static_cast<std::size_t>(e)];
      if (!edge.seen) continue;
      incidence_.push_back({edge.from, e});
      incidence_.push_back({edge.to, e});
      boxes.push_back(
          {Join(BoxOf(point_[edge.from]), BoxOf(point_[edge.to])), e, static_cast<std::int32_t>(o)});
    }
  // A sweep over the edges' bounding boxes, which are rounded outwards, finds pairs of edges that may cross.
  // Pairs of edges of one outline are skipped because an outline does not cross itself. Crossings of
  // occluders' edges with the outline of the source are already known.
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
    return a.box.low.x() != b.box.low.x() ? a.box.low.x() < b.box.low.x() : a.edge < b.edge;
  });
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (std::size_t m = k + 1; m < boxes.size() && boxes[m].box.low.x() <= boxes[k].box.high.x(); ++m)
      if (boxes[k].outline != boxes[m].outline && boxes[k].box.Meets(boxes[m].box))
        Meet(boxes[k].edge, boxes[m].edge);

  std::vector<std::size_t> order;
  std::vector<bool> used(point_.size(), false);
  for (const Incidence& i : incidence_) {
    if (!used[i.point]) order.push_back(i.point);
    used[i.point] = true;
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return a != b && point_[a] < point_[b]; });
  std::vector<std::int32_t> place_of(point_.size(), -1);
  for (const std::size_t k : order) {
    const Point& point = point_[k];
    if (places_.empty() || places_.back().point != point) {
      Place& place = places_.emplace_back();
      place.point = point;
      place.offset = {ToDouble(point.x(), offset_error()), ToDouble(point.y(), offset_error())};
      place.box = BoxOf(point);
    }
    place_of[k] = static_cast<std::int32_t>(places_.size()) - 1;
  }
  on_edge_.resize(edges_.size());
  for (const Incidence& i : incidence_)
    on_edge_[static_cast<std::size_t>(i.edge)].push_back(place_of[i.point]);
  for (std::vector<std::int32_t>& on : on_edge_) {
    std::sort(on.begin(), on.end());
    on.erase(std::unique(on.begin(), on.end()), on.end());
  }
}

// Clips a polygon of directions to the half-space in front of a plane through the viewpoint. If the new edge
// is half of a great circle through the zenith, a vertex is added at the zenith, because edges must be
// shorter than pi.
template <class Kernel>
auto ExactImage<Kernel>::PartBefore(const Directions& polygon, const Vec3& plane,
                                    const std::array<Number, 3>& zenith) -> Directions {
  std::vector<Number> height;
  for (const auto& d : polygon) height.push_back(d[0] * plane.x() + d[1] * plane.y() + d[2] * plane.z());
  Directions kept;
  if (std::none_of(height.begin(), height.end(), [](const Number& h) { return h > 0; })) return kept;
  std::vector<bool> in_plane;
  const auto add = [&](const std::array<Number, 3>& d, bool cut) {
    kept.push_back(d);
    in_plane.push_back(cut);
  };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = k + 1 == polygon.size() ? 0 : k + 1;
    const auto &a = polygon[k], &b = polygon[next];
    const Number &ha = height[k], &hb = height[next];
    if (ha >= 0) add(a, ha == 0);
    if (!((ha > 0 && hb < 0) || (ha < 0 && hb > 0))) continue;
    const Number wa = abs(hb), wb = abs(ha);
    add({wa * a[0] + wb * b[0], wa * a[1] + wb * b[1], wa * a[2] + wb * b[2]}, true);
  }
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::size_t next = k + 1 == kept.size() ? 0 : k + 1;
    const auto &a = kept[k], &b = kept[next];
    if (!in_plane[k] || !in_plane[next] || a[0] * b[0] + a[1] * b[1] + a[2] * b[2] >= 0) continue;
    kept.insert(kept.begin() + static_cast<std::ptrdiff_t>(k) + 1, zenith);
    break;
  }
  return kept;
}

template <class Kernel>
template <class Body>
void ExactImage<Kernel>::ForEachPart(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                     const Vec3& normal, double min_segment, const Body& body) {
  if (source.size() < 3) return;
  Directions whole;
  for (int v = 0; v < source.size(); ++v)
    whole.push_back({Number(source[v].x()), Number(source[v].y()), Number(source[v].z())});

  // The smallest permissible cosine between a direction and the axis, which limits the size of the image.
  constexpr double kLeastCosine = 0.2;
  Vec3 best = Vec3::Zero();
  double best_cosine = kLeastCosine;
  for (int k = 0; k < 6; ++k) {
    const Vec3 axis = k < 3 ? Vec3::Unit(k) : Vec3(-Vec3::Unit(k - 3));
    double least = 1;
    for (int v = 0; v < source.size(); ++v) least = std::min(least, axis.dot(source[v]) / source[v].norm());
    if (least > best_cosine) {
      best_cosine = least;
      best = axis;
    }
  }
  if (best_cosine > kLeastCosine) {
    body(ExactImage(ImagePlane(best), whole, occluders, min_segment));
    return;
  }

  // Two planes through the normal cut the source into four parts, one for each pair of the signs st and su.
  // All directions of a part of the source lie within 55 degrees of the axis normal + st * t + su * u, where
  // t and u are unit vectors perpendicular to `normal`.
  int across = 0;
  normal.cwiseAbs().minCoeff(&across);
  const Vec3 t = normal.cross(Vec3::Unit(across)).normalized(), u = normal.cross(t);
  const std::array<Number, 3> zenith = {Number(normal.x()), Number(normal.y()), Number(normal.z())};
  for (const double st : {1.0, -1.0})
    for (const double su : {1.0, -1.0}) {
      const Directions part = PartBefore(PartBefore(whole, st * t, zenith), su * u, zenith);
      if (part.size() >= 3)
        body(ExactImage(ImagePlane(normal + st * t + su * u), part, occluders, min_segment));
    }
}

}  // namespace penumbra
