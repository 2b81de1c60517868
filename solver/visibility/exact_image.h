// solver/visibility/exact_image.h
//
// What a point sees of a source and its occluders as a plane figure in exact numbers: the common ground of
// backprojection and vertex tracing. Every coincidence of the doubles that come in (shared corners and
// edges, three edges through a point) is an exact equality here, and what nearly coincides is an exact
// sliver. There is no tolerance.
//
// A template over CGAL's kernel, so that only sources include CGAL.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "solver/base/check.h"
#include "solver/visibility/direction_polygon.h"

namespace penumbra {

// The image point of direction d is (d_i / (axis . d) - origin.x, d_j / (axis . d) - origin.y). The map keeps
// orientation: what runs counter-clockwise about its inside as a DirectionPolygon does so in the image.
struct ImagePlane {
  Vec3 axis = Vec3::UnitZ();
  int i = 0, j = 1, k = 2;
  Vec2 origin = Vec2::Zero();

  // The plane axis . p = 1, with the two coordinates most perpendicular to the axis.
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
  // An image vector as a vector of the plane. Base() + Lift(p) is the direction of image point p.
  Vec3 Lift(const Vec2& vector) const {
    Vec3 lifted;
    lifted[i] = vector.x();
    lifted[j] = vector.y();
    lifted[k] = -(axis[i] * vector.x() + axis[j] * vector.y()) / axis[k];
    return lifted;
  }
};

// A box of doubles that holds an exact point or figure.
struct ImageBox {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());

  bool Meets(const ImageBox& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

// What an edge belongs to, if not to the occluder with that number.
inline constexpr std::int32_t kSourceOutline = -1;
inline constexpr std::int32_t kDiagonal = -2;  // between two parts of one occluder

template <class Kernel>
class ExactImage {
 public:
  using Number = typename Kernel::FT;
  using Point = typename Kernel::Point_2;
  using Line = typename Kernel::Line_2;

  // A direction as image point (x / w, y / w); behind the image plane w is negative.
  struct Homogeneous {
    Number x, y, w;
    bool diagonal = false;  // of a corner: the edge that begins here is not the outline's own
  };

  // An edge of the source's or of an occluder's outline.
  struct Edge {
    Line line;                              // what the outline bounds lies on its positive side
    std::int32_t outline = kSourceOutline;  // or kDiagonal or the occluder's number
    bool seen = false;                      // a part of it lies in the source
    Point from, to;                         // that part
  };

  // A convex region bounded by the lines of edges[first ... last - 1].
  struct Outline {
    std::int32_t first = 0, last = 0;
    ImageBox box;
  };

  // Where corners and edges are in one place.
  struct Place {
    Point point;
    ImageBox box;
    Vec2 offset = Vec2::Zero();  // the point in doubles
  };

  // Of the part of the source with these vertices, all of which lie before the plane's axis. Segments of the
  // occluders' outlines shorter than min_segment times the diameter of the source are collapsed.
  ExactImage(const ImagePlane& plane, std::span<const std::array<Number, 3>> source,
             std::span<const Occluder> occluders, double min_segment)
      : plane_(plane) {
    if (!ImageSource(source)) return;
    for (std::size_t o = 0; o < occluders.size(); ++o)
      ImageOccluder(*occluders[o].cone, static_cast<std::int32_t>(o), min_segment);
    FindPlaces();
  }

  // Calls body(image) for images of parts of the source that together show all of it. A hemisphere may need
  // four.
  template <class Body>
  static void ForEachPart(const DirectionPolygon& source, std::span<const Occluder> occluders,
                          const Vec3& normal, double min_segment, const Body& body);

  bool empty() const { return source_.last == 0; }
  const ImagePlane& plane() const { return plane_; }
  // Source first, then the occluders that the source's edges do not part from it.
  const Outline& source() const { return source_; }
  const std::vector<Outline>& occluders() const { return occluders_; }
  const std::vector<Edge>& edges() const { return edges_; }
  // The normal of the plane through the viewpoint that is seen as the line; it points to the positive side.
  Vec3 NormalOf(const Line& line) const {
    const Number a = line.a(), b = line.b(), c = line.c() - a * plane_.origin.x() - b * plane_.origin.y();
    const double size = std::abs(ToDouble(a, 0)) + std::abs(ToDouble(b, 0)) + std::abs(ToDouble(c, 0));
    const double accuracy = 1e-17 * size;
    Vec3 normal = ToDouble(c, accuracy) * plane_.axis;
    normal[plane_.i] = ToDouble(a + c * plane_.axis[plane_.i], accuracy);
    normal[plane_.j] = ToDouble(b + c * plane_.axis[plane_.j], accuracy);
    return normal;
  }
  // Corners of the source, corners of occluders inside it and crossings of edges; lexicographically
  // ascending, so that their numbers ascend or descend along any line.
  const std::vector<Place>& places() const { return places_; }
  // The places on what is seen of an edge, ascending.
  const std::vector<std::int32_t>& PlacesOn(std::int32_t edge) const {
    return on_edge_[static_cast<std::size_t>(edge)];
  }

  // A number in doubles: off by less than `accuracy` or than its last digits.
  static double ToDouble(const Number& number, double accuracy) {
    auto [low, high] = to_interval(number);
    if (high - low > std::max(2 * accuracy, kLastDigits * std::abs(low + high))) {
      number.exact();
      std::tie(low, high) = to_interval(number);
    }
    return 0.5 * (low + high);
  }

 private:
  static constexpr double kLastDigits = 2 * std::numeric_limits<double>::epsilon();

  // Offsets of places are off by less than this, relative to the diameter of the source. Their intervals
  // usually are as narrow; where not, exact numbers are called for.
  static constexpr double kOffsetAccuracy = 1e-14;

  // Below this diameter of the source, in the image, intervals about the lines are narrowed first: crossings
  // computed from them then keep their digits without exact numbers.
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

  static Point Crossing(const Line& a, const Line& b) {
    const auto meeting = intersection(a, b);
    PENUMBRA_CHECK(meeting);
    const Point* point = get<Point>(&*meeting);
    PENUMBRA_CHECK(point);
    return *point;
  }

  // The convex hull, which differs from the polygon by the roundings of its vertices only: false if it has no
  // inside.
  bool ImageSource(std::span<const std::array<Number, 3>> source);
  void ImageOccluder(const Cone& cone, std::int32_t number, double min_segment);
  void AddOccluder(std::span<const Homogeneous> outline, std::int32_t number);
  void CollapseShort(double length, std::vector<Homogeneous>& outline) const;
  void ClipToSource(const Homogeneous& a, const Homogeneous& b, Edge& edge) const;

  struct Found {
    Point point;
    std::int32_t edge;
  };
  void Meet(std::int32_t a, std::int32_t b, std::vector<Found>& found) const;
  void FindPlaces();

  ImagePlane plane_;
  double diameter_ = 0;
  std::vector<Point> corner_;
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
  // The origin is the first vertex, nearly, so that a tiny far source keeps its digits.
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
  if (diameter_ < kSmallSource)
    for (const Point& p : points) p.exact();

  // Lower hull, then upper hull.
  const auto extend = [&](const Point& p, std::size_t least) {
    while (corner_.size() > least && !left_turn(corner_[corner_.size() - 2], corner_.back(), p))
      corner_.pop_back();
    corner_.push_back(p);
  };
  for (const Point& p : points) extend(p, 1);
  const std::size_t lower = corner_.size();
  for (std::size_t k = points.size() - 1; k-- > 0;) extend(points[k], lower);
  corner_.pop_back();
  if (corner_.size() < 3) return false;

  for (std::size_t k = 0; k < corner_.size(); ++k) {
    Edge& edge = edges_.emplace_back();
    edge.from = corner_[k];
    edge.to = corner_[k + 1 == corner_.size() ? 0 : k + 1];
    edge.line = Line(edge.from, edge.to);
    if (diameter_ < kSmallSource) edge.line.exact();
    edge.seen = true;
    source_.box = Join(source_.box, BoxOf(edge.from));
  }
  source_.last = static_cast<std::int32_t>(edges_.size());
  return true;
}

// Both ends of a short edge become its middle: the outline stays convex.
template <class Kernel>
void ExactImage<Kernel>::CollapseShort(double length, std::vector<Homogeneous>& outline) const {
  const auto at = [&](const Homogeneous& h) {
    return Vec2(ToDouble(h.x / h.w, 1e-16), ToDouble(h.y / h.w, 1e-16));
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

  // A corner that roundings turned inwards goes, or the plane of a short edge could cut the cone in two. Of
  // long edges the planes are safe.
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
    for (const Point& p : corner_)
      for (const Point& q : corner_)
        longest = std::max(
            longest, plane_.Lift({ToDouble(p.x() - q.x(), 1e-16), ToDouble(p.y() - q.y(), 1e-16)}).norm());
    CollapseShort(min_segment * longest, outline);
  }
  AddOccluder(outline, number);
}

template <class Kernel>
void ExactImage<Kernel>::AddOccluder(std::span<const Homogeneous> outline, std::int32_t number) {
  const std::size_t n = outline.size();
  if (n < 3 || (n == 3 && Dot(Cross(outline[0], outline[1]), outline[2]) <= 0)) return;
  // Three directions of nearly a half circle, one of them turned inwards by roundings: two convex halves.
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

  // Whether an edge of the source parts it from the occluder.
  for (std::int32_t s = source_.first; s < source_.last; ++s) {
    const Line& line = edges_[static_cast<std::size_t>(s)].line;
    if (std::none_of(outline.begin(), outline.end(),
                     [&](const Homogeneous& h) { return Height(line, h) > 0; }))
      return;
  }

  Outline& region = occluders_.emplace_back();
  region.first = static_cast<std::int32_t>(edges_.size());
  bool before = true;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Homogeneous &a = outline[k], &b = outline[k + 1 == outline.size() ? 0 : k + 1];
    Edge edge;
    edge.outline = a.diagonal ? kDiagonal : number;
    edge.line = LineThrough(a, b);
    if (!edge.line.is_degenerate()) {
      ClipToSource(a, b, edge);
      edges_.push_back(edge);
    }
    before = before && a.w > 0;
    if (before) region.box = Join(region.box, BoxOf(Point(a.x / a.w, a.y / a.w)));
  }
  region.last = static_cast<std::int32_t>(edges_.size());
  if (!before) region.box = source_.box;
}

// The part of the edge from a to b that lies in the source.
template <class Kernel>
void ExactImage<Kernel>::ClipToSource(const Homogeneous& a, const Homogeneous& b, Edge& edge) const {
  Homogeneous from = a, to = b;
  std::int32_t from_cut = -1, to_cut = -1;
  for (std::int32_t s = source_.first; s < source_.last; ++s) {
    const Line& line = edges_[static_cast<std::size_t>(s)].line;
    const Number hf = Height(line, from), ht = Height(line, to);
    if (hf <= 0 && ht <= 0) {
      // It may still run along the edge of the source.
      if (!(hf == 0 && ht == 0)) return;
      continue;
    }
    if (hf >= 0 && ht >= 0) continue;
    const Number wf = hf < 0 ? ht : -ht, wt = hf < 0 ? -hf : hf;
    const Homogeneous cut = {wf * from.x + wt * to.x, wf * from.y + wt * to.y, wf * from.w + wt * to.w};
    (hf < 0 ? from : to) = cut;
    (hf < 0 ? from_cut : to_cut) = s;
  }
  const auto end = [&](const Homogeneous& h, std::int32_t cut) {
    return cut < 0 ? Point(h.x / h.w, h.y / h.w)
                   : Crossing(edge.line, edges_[static_cast<std::size_t>(cut)].line);
  };
  edge.from = end(from, from_cut);
  edge.to = end(to, to_cut);
  if (diameter_ < kSmallSource) edge.from.exact(), edge.to.exact();
  edge.seen = edge.from != edge.to;
}

// The points that what is seen of two edges has in common, but for ends of both.
template <class Kernel>
void ExactImage<Kernel>::Meet(std::int32_t ia, std::int32_t ib, std::vector<Found>& found) const {
  const Edge &a = edges_[static_cast<std::size_t>(ia)], &b = edges_[static_cast<std::size_t>(ib)];
  const auto sa = a.line.oriented_side(b.from), ta = a.line.oriented_side(b.to);
  if (sa == ta && sa != 0) return;
  const auto sb = b.line.oriented_side(a.from), tb = b.line.oriented_side(a.to);
  if (sb == tb && sb != 0) return;
  const auto between = [](const Edge& e, const Point& p) {
    return (e.from < p && p < e.to) || (e.to < p && p < e.from);
  };
  if (sa == 0 && between(a, b.from)) found.push_back({b.from, ia});
  if (ta == 0 && between(a, b.to)) found.push_back({b.to, ia});
  if (sb == 0 && between(b, a.from)) found.push_back({a.from, ib});
  if (tb == 0 && between(b, a.to)) found.push_back({a.to, ib});
  if (sa == 0 || ta == 0 || sb == 0 || tb == 0) return;
  const Point crossing = Crossing(a.line, b.line);
  found.push_back({crossing, ia});
  found.push_back({crossing, ib});
}

template <class Kernel>
void ExactImage<Kernel>::FindPlaces() {
  const auto count = static_cast<std::int32_t>(edges_.size());
  std::vector<Found> found;
  struct Box {
    ImageBox box;
    std::int32_t edge;
  };
  std::vector<Box> boxes;
  for (std::int32_t e = 0; e < count; ++e) {
    const Edge& edge = edges_[static_cast<std::size_t>(e)];
    if (!edge.seen) continue;
    found.push_back({edge.from, e});
    found.push_back({edge.to, e});
    boxes.push_back({Join(BoxOf(edge.from), BoxOf(edge.to)), e});
  }
  // Candidates by a sweep over the boxes, which are rounded outwards.
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
    return a.box.low.x() != b.box.low.x() ? a.box.low.x() < b.box.low.x() : a.edge < b.edge;
  });
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (std::size_t m = k + 1; m < boxes.size() && boxes[m].box.low.x() <= boxes[k].box.high.x(); ++m)
      if (boxes[k].box.Meets(boxes[m].box)) Meet(boxes[k].edge, boxes[m].edge, found);

  std::vector<std::size_t> order(found.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return found[a].point < found[b].point; });
  on_edge_.resize(edges_.size());
  for (const std::size_t k : order) {
    const Found& f = found[k];
    if (places_.empty() || places_.back().point != f.point) {
      Place& place = places_.emplace_back();
      place.point = f.point;
      place.offset = {ToDouble(f.point.x(), kOffsetAccuracy * diameter_),
                      ToDouble(f.point.y(), kOffsetAccuracy * diameter_)};
      place.box = BoxOf(f.point);
    }
    auto& on = on_edge_[static_cast<std::size_t>(f.edge)];
    const auto number = static_cast<std::int32_t>(places_.size()) - 1;
    if (on.empty() || on.back() != number) on.push_back(number);
  }
}

template <class Kernel>
template <class Body>
void ExactImage<Kernel>::ForEachPart(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                     const Vec3& normal, double min_segment, const Body& body) {
  if (source.size() < 3) return;
  using Polygon = std::vector<std::array<Number, 3>>;
  Polygon whole;
  for (int v = 0; v < source.size(); ++v)
    whole.push_back({Number(source[v].x()), Number(source[v].y()), Number(source[v].z())});

  // The least cosine to the axis that a direction may have, to keep the image within reason.
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

  // Four parts by two planes through the normal. A quarter of the hemisphere lies within 55 degrees of the
  // sum of the three vectors.
  int across = 0;
  normal.cwiseAbs().minCoeff(&across);
  const Vec3 t = normal.cross(Vec3::Unit(across)).normalized(), u = normal.cross(t);
  // Where the cut runs over the zenith it may be half a great circle, and must have a vertex there.
  const std::array<Number, 3> zenith = {Number(normal.x()), Number(normal.y()), Number(normal.z())};
  const auto keep = [&](const Polygon& polygon, const Vec3& plane) {
    std::vector<Number> height;
    for (const auto& d : polygon) height.push_back(d[0] * plane.x() + d[1] * plane.y() + d[2] * plane.z());
    Polygon kept;
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
  };
  for (const double st : {1.0, -1.0})
    for (const double su : {1.0, -1.0}) {
      const Polygon part = keep(keep(whole, st * t), su * u);
      if (part.size() >= 3)
        body(ExactImage(ImagePlane(normal + st * t + su * u), part, occluders, min_segment));
    }
}

}  // namespace penumbra
