#include "mesh/discontinuities/irradiance_jump.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace penumbra {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The data that all events at one point of the receiver share.
struct View {
  const Vec3& x;
  const Vec3& normal;  // the receiver's normal
  const Vec3& across;
  const Patch& source;

  // The irradiance from a unit area of the source at y with unit radiosity [1/m^2].
  double Kernel(const Vec3& y) const {
    const Vec3 r = y - x;
    const double squared = r.squaredNorm();
    const double cosines = normal.dot(r) * -source.normal.dot(r);
    return cosines > 0 ? cosines / (std::numbers::pi * squared * squared) : 0;
  }
};

// A straight line of the image on the source's plane.
struct SourceLine {
  Vec3 along, across;  // unit vectors in the source's plane
};

// The distance along the line per unit distance across it, for a direction in the image, and the side of the
// line to which the direction points.
struct Slope {
  double slope;
  int side;  // 0: parallel to the line
};

Slope SlopeOf(const Vec3& direction, const SourceLine& line) {
  const double along = direction.dot(line.along), across = direction.dot(line.across);
  if (across == 0) return {kInfinity, 0};
  return {along / across, across > 0 ? 1 : -1};
}

// The image of the blocker's edge ab on the source's plane, and the speed of the image.
class MovingEdge {
 public:
  MovingEdge(const View& view, const Vec3& a, const Vec3& b)
      : view_(view), a_(a), edge_(b - a), plane_((a - view.x).cross(b - view.x)) {
    Vec3 along = view.source.normal.cross(plane_);
    const double length = along.norm();
    valid_ = length > 0;
    if (!valid_) return;
    along /= length;
    line_ = {along, view.source.normal.cross(along)};
  }

  bool valid() const { return valid_; }
  const SourceLine& line() const { return line_; }
  // The speed of the image's point y, along line().across, for a unit step of x [1].
  double SpeedAt(const Vec3& y) const {
    return view_.across.cross(edge_).dot(y - a_) / plane_.dot(line_.across);
  }
  // Proportional to the signed distance of p's image from the line.
  double Side(const Vec3& p) const {
    const double side = plane_.dot(p - a_);
    return plane_.dot(line_.across) > 0 ? side : -side;
  }

 private:
  const View& view_;
  Vec3 a_, edge_, plane_;
  bool valid_ = false;
  SourceLine line_;
};

// +1 if the faces at the edge cover the side of the moving line to which `across` points, otherwise -1.
int CoveredSide(const Scene& scene, const Silhouettes& silhouettes, PatchId blocker, std::int32_t k,
                const MovingEdge& moving) {
  double largest = 0;
  for (const PatchEdge& at : silhouettes.Sharing(silhouettes.EdgeAt(blocker, k)))
    for (const Vec3& v : scene.patches[at.patch].Vertices()) {
      const double side = moving.Side(v);
      if (std::abs(side) > std::abs(largest)) largest = side;
    }
  return largest >= 0 ? 1 : -1;
}

double SourceDiameter(const Patch& source) { return Diameter(source.Vertices()); }

// `chord` bounds the chords of the source, by the source's diameter and by the image of the blocker's edge.
void BoundGradient(IrradianceJump* jump, double kernel, double speed, double chord, double source_area) {
  jump->largest_gradient = kernel * std::abs(speed) * chord;
  jump->largest_value = std::min(1.0, kernel * source_area);
}

// Both edges lie in one plane with x: the jump of the gradient is proportional to the length that they share.
IrradianceJump EdgeEdge(const Scene& scene, const Silhouettes& silhouettes, const View& view,
                        std::int32_t source_edge, PatchId blocker, std::int32_t k) {
  const Patch& patch = scene.patches[blocker];
  const Vec3 &a = patch.vertex[k], &b = patch.vertex[(k + 1) % patch.size];
  const Vec3 &v = view.source.vertex[source_edge],
             &w = view.source.vertex[(source_edge + 1) % view.source.size];
  const MovingEdge moving(view, a, b);
  IrradianceJump jump;
  if (!moving.valid()) return jump;
  const Vec3 plane = (a - view.x).cross(b - view.x);
  // The position on the source's edge where a point of the blocker appears.
  const auto appears = [&](const Vec3& p) {
    const Vec3 side = plane.cross(p - view.x);
    return side.dot(view.x - v) / side.dot(w - v);
  };
  const double ta = appears(a), tb = appears(b);
  if (!std::isfinite(ta) || !std::isfinite(tb)) return jump;
  const double t0 = std::clamp(std::min(ta, tb), 0.0, 1.0), t1 = std::clamp(std::max(ta, tb), 0.0, 1.0);
  if (!(t0 < t1)) return jump;
  // Gauss's rule with two points.
  double sum = 0;
  constexpr double kNode = 0.21132486540518713;
  for (const double s : {kNode, 1 - kNode}) {
    const Vec3 y = v + (t0 + s * (t1 - t0)) * (w - v);
    sum += 0.5 * view.Kernel(y) * std::abs(moving.SpeedAt(y));
  }
  const Vec3 inside = Centroid(view.source.Vertices()) - v;
  const int source_side = inside.dot(moving.line().across) > 0 ? 1 : -1;
  const int covered = CoveredSide(scene, silhouettes, blocker, k, moving);
  // The formula is for a covered lower side: see VertexEdge().
  jump.gradient = covered * source_side * sum * (t1 - t0) * (w - v).norm();
  jump.largest_gradient = std::abs(jump.gradient);
  jump.curvature = kInfinity;
  jump.largest_value = std::min(1.0, view.Kernel(v + 0.5 * (t0 + t1) * (w - v)) * view.source.area);
  return jump;
}

IrradianceJump VertexEdge(const Scene& scene, const Silhouettes& silhouettes, const View& view,
                          const Discontinuity& d) {
  const Patch& blocker = scene.patches[d.blocker];
  const Vec3 &a = blocker.vertex[d.blocker_part], &b = blocker.vertex[(d.blocker_part + 1) % blocker.size];
  const Vec3& v = view.source.vertex[d.source_part];
  IrradianceJump jump;
  const MovingEdge moving(view, a, b);
  if (!moving.valid()) return jump;
  const std::int32_t size = view.source.size;
  const Slope next = SlopeOf(view.source.vertex[(d.source_part + 1) % size] - v, moving.line());
  const Slope last = SlopeOf(view.source.vertex[(d.source_part + size - 1) % size] - v, moving.line());
  // The length of the chord at height z grows from zero at a corner of the source, where its slope jumps up,
  // and bends inwards at a corner to the side.
  const double bend = (next.side == last.side ? 1 : -1) * std::abs(next.slope - last.slope);
  const double speed = moving.SpeedAt(v), kernel = view.Kernel(v);
  const int covered = CoveredSide(scene, silhouettes, d.blocker, d.blocker_part, moving);
  // If the lower side is covered, the visible area loses the chord with each step up.
  jump.curvature = covered * (speed > 0 ? 1 : -1) * speed * speed * bend * kernel;
  const double magnified = (v - view.x).norm() / (0.5 * (a + b) - view.x).norm();
  BoundGradient(&jump, kernel, speed,
                std::min(SourceDiameter(view.source), std::max(1.0, magnified) * (b - a).norm()),
                view.source.area);
  return jump;
}

IrradianceJump EdgeVertex(const Scene& scene, const Silhouettes& silhouettes, const View& view,
                          const Discontinuity& d) {
  const Vec3& b = scene.patches[d.blocker].vertex[d.blocker_part];
  const Vec3& v = view.source.vertex[d.source_part];
  const Vec3 along = (view.source.vertex[(d.source_part + 1) % view.source.size] - v).normalized();
  const SourceLine line = {along, view.source.normal.cross(along)};  // the source lies above the line
  const Vec3 ray = b - view.x;
  const double approach = view.source.normal.dot(ray);
  IrradianceJump jump;
  if (approach == 0) return jump;
  const double magnified = view.source.normal.dot(v - view.x) / approach;  // image of b / b, as distances
  if (!(magnified > 1)) return jump;
  const Vec3 y = view.x + magnified * ray;
  // The image moves in the opposite direction of x.
  const Vec3 shift =
      -(magnified - 1) * (view.across - ray * (view.source.normal.dot(view.across) / approach));
  const double speed = shift.dot(line.across), kernel = view.Kernel(y);

  const std::int32_t corner = silhouettes.CornerAt(d.blocker, d.blocker_part);
  std::array<Slope, 2> slope;
  int count = 0;
  double longest = 0;
  for (const std::int32_t edge : silhouettes.EdgesAround(corner)) {
    // The faces at the edge contain b: each faces the source's point exactly if it faces away from x.
    if (!silhouettes.IsSilhouette(edge, view.x)) continue;
    const Vec3 away = silhouettes.Away(edge, corner);
    longest = std::max(longest, magnified * away.norm());
    if (count < 2) slope[count] = SlopeOf(away - ray * (view.source.normal.dot(away) / approach), line);
    ++count;
  }
  if (count < 2) return jump;
  const double bend = (slope[0].side == slope[1].side ? 1 : -1) * std::abs(slope[0].slope - slope[1].slope);
  // The covered area gains the chord that the source's edge cuts out of the corner's image.
  jump.curvature = -(speed > 0 ? 1 : -1) * speed * speed * bend * kernel;
  BoundGradient(&jump, kernel, speed, std::min(SourceDiameter(view.source), longest), view.source.area);
  return jump;
}

IrradianceJump TripleEdge(const Scene& scene, const Silhouettes& silhouettes, const View& view,
                          const Discontinuity& d) {
  IrradianceJump jump;
  std::array<PatchEdge, 3> edge = {PatchEdge{d.blocker, d.blocker_part}, d.second_blocker_edge,
                                   d.third_blocker_edge};
  const bool of_source = d.source_part >= 0;
  if (of_source) edge[2] = {d.source, d.source_part};
  std::array<std::array<Vec3, 2>, 3> end;
  std::array<Vec3, 3> plane;  // normals of the planes of x and each edge
  for (int i = 0; i < 3; ++i) {
    const Patch& patch = scene.patches[edge[i].patch];
    end[i] = {patch.vertex[edge[i].k], patch.vertex[(edge[i].k + 1) % patch.size]};
    plane[i] = (end[i][0] - view.x).cross(end[i][1] - view.x);
  }
  // Where the edges meet in the source's plane: on the source's edge, or behind the crossing of two edges.
  const Vec3 from = of_source ? end[2][0] : view.x;
  const Vec3 way = of_source ? Vec3(end[2][1] - end[2][0]) : plane[0].cross(plane[1]);
  const Vec3& across = of_source ? plane[0] : view.source.normal;
  const double rate = across.dot(way);
  if (rate == 0) return jump;
  const Vec3 y = from + (across.dot((of_source ? view.x : view.source.vertex[0]) - from) / rate) * way;

  // The visible region is the overlap of three half planes, with these outward normals and these speeds of
  // growth.
  std::array<Vec3, 3> outward;
  std::array<double, 3> speed = {0, 0, 0};
  double chord = SourceDiameter(view.source), fastest = 0;
  for (int i = 0; i < 3; ++i) {
    const auto& [a, b] = end[i];
    if (edge[i].patch == d.source) {
      outward[i] = -view.source.normal.cross(b - a).normalized();  // the source lies to the left of its edge
      continue;
    }
    const MovingEdge moving(view, a, b);
    if (!moving.valid()) return jump;
    const int covered = CoveredSide(scene, silhouettes, edge[i].patch, edge[i].k, moving);
    outward[i] = covered * moving.line().across;
    speed[i] = covered * moving.SpeedAt(y);
    fastest = std::max(fastest, std::abs(speed[i]));
    const double magnified = (y - view.x).norm() / (0.5 * (a + b) - view.x).norm();
    chord = std::min(chord, std::max(1.0, magnified) * (b - a).norm());
  }
  std::array<double, 3> sine;
  double sum = 0, product = 1;
  for (int i = 0; i < 3; ++i) {
    sine[i] = view.source.normal.dot(outward[(i + 1) % 3].cross(outward[(i + 2) % 3]));
    sum += sine[i] * speed[i];
    product *= sine[i];
  }
  if (product == 0) return jump;
  // If all sines have one sign, the overlap is the triangle. Otherwise, the half plane whose sine has the
  // other sign cuts the triangle off a corner of the other two.
  int odd = 0;
  for (int i = 0; i < 3; ++i)
    if ((sine[i] > 0) != (sine[(i + 1) % 3] > 0) && (sine[i] > 0) != (sine[(i + 2) % 3] > 0)) odd = i;
  const double kernel = view.Kernel(y);
  jump.curvature = kernel * (sum / sine[odd] > 0 ? 1 : -1) * sum * sum / std::abs(product);
  BoundGradient(&jump, kernel, fastest, chord, view.source.area);
  return jump;
}

// The irradiance is zero behind the source's plane. In front of it, the cosine at the source is proportional
// to the distance from the plane.
IrradianceJump Horizon(const View& view) {
  const double tilt = std::abs(view.source.normal.dot(view.across));
  IrradianceJump jump;
  // The mean over the source by a tensor product of Gauss's rule with three points.
  constexpr std::array<double, 3> kNode = {0.11270166537925831, 0.5, 0.8872983346207417};
  constexpr std::array<double, 3> kWeight = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0, total = 0;
  const auto& c = view.source.vertex;
  const Vec3& last = view.source.size == 4 ? c[3] : c[2];  // a triangle has a fourth side of length zero
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double s = kNode[i], t = kNode[j];
      const Vec3 y = (1 - s) * (1 - t) * c[0] + s * (1 - t) * c[1] + s * t * c[2] + (1 - s) * t * last;
      const Vec3 du = (1 - t) * (c[1] - c[0]) + t * (c[2] - last);
      const Vec3 dv = (1 - s) * (last - c[0]) + s * (c[2] - c[1]);
      const double area = kWeight[i] * kWeight[j] * du.cross(dv).norm();
      const double distance = (y - view.x).norm();
      total += area;
      if (distance > 0)
        sum += area * std::max(0.0, view.normal.dot(y - view.x)) / std::pow(distance, 4) / std::numbers::pi;
    }
  jump.gradient = total > 0 ? tilt * sum * view.source.area / total : 0;
  jump.largest_gradient = jump.gradient;
  jump.curvature = kInfinity;
  jump.largest_value = 1;
  return jump;
}

// The jump at a line along an edge that hangs at height h above the receiver, at distance q h from the edge.
// Near a long edge the irradiance is (1 - q / sqrt(1 + q^2)) / 2 times the source's radiosity. In place of a
// jump of the second derivative, the function uses the second derivative itself; at q = 0, where the second
// derivative changes its sign, its value at the next line.
IrradianceJump NearEdge(const View& view, std::int32_t edge) {
  constexpr double kInflection = 0.5;
  const Vec3 &a = view.source.vertex[static_cast<std::size_t>(edge)],
             &b = view.source.vertex[static_cast<std::size_t>((edge + 1) % view.source.size)];
  const Vec3 along = (b - a).normalized();
  const Vec3 from = view.x - a;
  const Vec3 off = from - from.dot(along) * along;
  const double height = std::abs(view.normal.dot(off));
  if (height == 0) return {};
  const double q = std::sqrt(std::max(0.0, off.squaredNorm() - height * height)) / height;
  const double bend = std::max(q, kInflection);
  IrradianceJump jump;
  jump.curvature = 1.5 * bend * std::pow(1 + bend * bend, -2.5) / (height * height);
  jump.largest_gradient = 0.5 * std::pow(1 + q * q, -1.5) / height;
  jump.largest_value = 0.5 * (1 - q / std::sqrt(1 + q * q));
  return jump;
}

}  // namespace

std::int32_t CoplanarEdge(const Patch& source, std::int32_t k, const Vec3& a, const Vec3& b,
                          double tolerance) {
  const Vec3& s = source.vertex[k];
  const Vec3 normal = (b - s).cross(a - s);
  const double length = normal.norm();
  if (length == 0) return -1;
  const std::int32_t before = (k + source.size - 1) % source.size, after = (k + 1) % source.size;
  const double next = std::abs(normal.dot(source.vertex[after] - s));
  const double last = std::abs(normal.dot(source.vertex[before] - s));
  if (std::min(next, last) > tolerance * length) return -1;
  return next <= last ? k : before;
}

IrradianceJump JumpAt(const Scene& scene, const Silhouettes& silhouettes, const Discontinuity& d,
                      const Vec3& x, const Vec3& across) {
  if (d.source == kNoPatch) return {};
  const View view = {x, scene.patches[d.receiver].normal, across, scene.patches[d.source]};
  if (d.kind == DiscontinuityKind::kHorizon) return Horizon(view);
  if (d.kind == DiscontinuityKind::kNear) return NearEdge(view, d.source_part);
  if (d.shared_source_edge >= 0)
    return EdgeEdge(scene, silhouettes, view, d.shared_source_edge, d.shared_blocker_edge.patch,
                    d.shared_blocker_edge.k);
  if (d.kind == DiscontinuityKind::kEEE) return TripleEdge(scene, silhouettes, view, d);
  return d.kind == DiscontinuityKind::kVE ? VertexEdge(scene, silhouettes, view, d)
                                          : EdgeVertex(scene, silhouettes, view, d);
}

}  // namespace penumbra
