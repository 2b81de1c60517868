#include "solver/visibility/point/form_factor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/visibility/point/arc_tangent.h"
#include "solver/visibility/point/image_frame.h"

namespace penumbra {
namespace {

// The sum over the edges, and the sum of their angles. Rounding turns the normal of each edge by about 1e-16;
// the resulting error of the edge's term is proportional to the edge's angle, even if the term is small.
struct EdgeSum {
  double value = 0, angles = 0;

  void Add(const Vec3& m, double cosine, const Vec3& normal) {
    const double length = m.norm();
    if (length == 0) return;
    const double angle = internal::AngleOf(length, cosine);
    value += normal.dot(m) / length * angle;
    angles += angle;
  }
  bool Cancels(double allowed) const { return angles > allowed * std::abs(value); }
  double FormFactor() const { return std::max(0.0, value * (0.5 * std::numbers::inv_pi)); }
};

// Gauss-Legendre rules on [0, 1].
template <std::size_t N>
struct GaussRule {
  std::array<double, N> node, weight;
};
constexpr GaussRule<4> kFour = {
    {0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
    {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693}};
constexpr GaussRule<6> kSix = {{0.033765242898423975, 0.16939530676686776, 0.38069040695840156,
                                0.61930959304159849, 0.83060469323313224, 0.96623475710157603},
                               {0.085662246189585178, 0.18038078652406930, 0.23395696728634552,
                                0.23395696728634552, 0.18038078652406930, 0.085662246189585178}};
constexpr GaussRule<8> kEight = {
    {0.019855071751231884, 0.10166676129318664, 0.23723379504183550, 0.40828267875217510, 0.59171732124782490,
     0.76276620495816450, 0.89833323870681336, 0.98014492824876812},
    {0.050614268145188130, 0.11119051722668724, 0.15685332293894364, 0.18134189168918099, 0.18134189168918099,
     0.15685332293894364, 0.11119051722668724, 0.050614268145188130}};

// On a part of diameter h at distance r, seen along its line of sight, the error is at most 3.7e-3 (h / r)^8
// with four nodes and 3.4e-7 (h / r)^16 with eight (the remainder of Gauss quadrature for 1 / r^4): about
// 1e-15 with these limits.
constexpr double kFarForFour = 0.03, kFarForSix = 0.15, kFarForEight = 0.4;
constexpr int kMostHalvings = 120;

// An edge is seen end-on if the sine of the angle between the edge and the line of sight is below this. About
// a hundred roundings: the plane through the point and the edge is then undefined.
constexpr double kEndOn = 1e-14;

// A convex quadrilateral as the image of the unit square: p(s, t) = corner + s u + t v + s t w. Two vertices
// may coincide.
struct Bilinear {
  Vec3 corner, u, v, w;
  double h0, hu, hv, hw;  // height of p above the horizon: h0 + s hu + t hv + s t hw
  double c0, c1, c2, c3;  // p . (dp/ds x dp/dt): c0 + s c1 + t c2 + s t c3

  Bilinear(const Vec3& base, const Vec3& o0, const Vec3& o1, const Vec3& o2, const Vec3& o3,
           const Vec3& normal)
      : corner(base + o0), u(o1 - o0), v(o3 - o0), w((o2 - o1) - (o3 - o0)) {
    h0 = normal.dot(corner), hu = normal.dot(u), hv = normal.dot(v), hw = normal.dot(w);
    c0 = corner.dot(u.cross(v)), c1 = corner.dot(u.cross(w)), c2 = corner.dot(w.cross(v));
    c3 = -u.dot(v.cross(w));  // zero up to rounding for planar quadrilaterals
  }
  Vec3 At(double s, double t) const { return corner + s * u + t * (v + s * w); }
};

// A part of the unit square.
struct Box {
  double s, t, width, height;
};

template <std::size_t N>
double Integrate(const Bilinear& q, const Box& box, const GaussRule<N>& rule) {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j) {
      const double s = box.s + box.width * rule.node[i], t = box.t + box.height * rule.node[j];
      const double rise = std::max(0.0, q.h0 + s * q.hu + t * (q.hv + s * q.hw));
      const double square = q.At(s, t).squaredNorm();
      sum += rule.weight[i] * rule.weight[j] * rise * (q.c0 + s * q.c1 + t * (q.c2 + s * q.c3)) /
             (square * square);
    }
  return sum * box.width * box.height;
}

// The integral of (n . p) (p . dA) / |p|^4 over a part of the quadrilateral. Halves parts that are close to
// the point.
double Integrate(const Bilinear& q, const Box& box, int halvings) {
  const double s1 = box.s + box.width, t1 = box.t + box.height;
  const std::array<Vec3, 4> p = {q.At(box.s, box.t), q.At(s1, box.t), q.At(s1, t1), q.At(box.s, t1)};
  const double nearest =
      std::sqrt(std::min({p[0].squaredNorm(), p[1].squaredNorm(), p[2].squaredNorm(), p[3].squaredNorm()}));
  const double along_s = std::max((p[1] - p[0]).squaredNorm(), (p[2] - p[3]).squaredNorm());
  const double along_t = std::max((p[3] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm());
  const double longest = std::sqrt(std::max(along_s, along_t));
  if (longest <= kFarForFour * nearest) return Integrate(q, box, kFour);
  if (longest <= kFarForSix * nearest) return Integrate(q, box, kSix);
  if (longest <= kFarForEight * nearest || halvings == kMostHalvings) return Integrate(q, box, kEight);
  Box first = box, second = box;
  if (along_s >= along_t) {
    first.width = second.width = 0.5 * box.width;
    second.s += first.width;
  } else {
    first.height = second.height = 0.5 * box.height;
    second.t += first.height;
  }
  return Integrate(q, first, halvings + 1) + Integrate(q, second, halvings + 1);
}

}  // namespace

double FormFactorByQuadrature(const Vec3& base, std::span<const Vec3> offset, const Vec3& normal) {
  // The distance of the plane is most accurate from the nearest vertex.
  const std::size_t n = offset.size();
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < n; ++i)
    if ((base + offset[i]).squaredNorm() < (base + offset[nearest]).squaredNorm()) nearest = i;
  const auto from_nearest = [&](std::size_t i) { return offset[(nearest + std::min(i, n - 1)) % n]; };
  double sum = 0;
  for (std::size_t i = 2; i < n; i += 2)
    sum += Integrate(
        Bilinear(base, from_nearest(0), from_nearest(i - 1), from_nearest(i), from_nearest(i + 1), normal),
        {0, 0, 1, 1}, 0);
  return std::max(0.0, sum * std::numbers::inv_pi);
}

double FormFactor(const Vec3& base, std::span<const Vec3> offset, const Vec3& normal) {
  EdgeSum sum;
  for (std::size_t i = 0; i < offset.size(); ++i) {
    const Vec3 a = base + offset[i], edge = offset[i + 1 == offset.size() ? 0 : i + 1] - offset[i];
    sum.Add(a.cross(edge), a.dot(a + edge), normal);
  }
  return sum.Cancels(kFormFactorCancellation) ? FormFactorByQuadrature(base, offset, normal)
                                              : sum.FormFactor();
}

double FormFactor(const DirectionPolygon& polygon, const Vec3& normal, double cancellation) {
  EdgeSum sum;
  for (int i = 0; i < polygon.size(); ++i)
    sum.Add(EdgeNormal(polygon[i], polygon.Next(i)), polygon[i].dot(polygon.Next(i)), normal);
  // A polygon without an image axis is seen all around, in a limit at a contact; its form factor is not
  // small.
  if (!sum.Cancels(cancellation) || ImageAxis(polygon).isZero(0)) return sum.FormFactor();
  std::array<Vec3, DirectionPolygon::kCapacity> offset;
  for (int i = 0; i < polygon.size(); ++i) offset[static_cast<std::size_t>(i)] = polygon[i] - polygon[0];
  return FormFactorByQuadrature(polygon[0], {offset.data(), static_cast<std::size_t>(polygon.size())},
                                normal);
}

Vec3 EdgeGradient(const Vec3& a, const Vec3& b, const Vec3& from, const Vec3& to, const Vec3& normal) {
  const Vec3 m = EdgeNormal(a, b);
  const double length = (b - a).norm(), area = m.norm();
  if (area <= kEndOn * length * std::max(a.norm(), b.norm())) return Vec3::Zero();
  // The foot of the perpendicular from the point to the line lies at distance area / length. Angles along the
  // edge are measured from the foot.
  const Vec3 along = (b - a) / length, left = m / area, foot = along.cross(left);
  const double from_angle = std::atan2(along.dot(from), foot.dot(from)),
               to_angle = std::atan2(along.dot(to), foot.dot(to));
  const double turn = to_angle - from_angle, middle = to_angle + from_angle;
  // The integral of (n . w) cos(angle) over the arc, where w = cos(angle) foot + sin(angle) along.
  const double share = 0.5 * normal.dot(foot) * (turn + std::sin(turn) * std::cos(middle)) +
                       0.5 * normal.dot(along) * std::sin(turn) * std::sin(middle);
  return share * std::numbers::inv_pi * length / area * left;
}

Vec3 FormFactorGradient(const DirectionPolygon& polygon, const Vec3& normal) {
  Vec3 gradient = Vec3::Zero();
  for (int i = 0; i < polygon.size(); ++i)
    gradient += EdgeGradient(polygon[i], polygon.Next(i), polygon[i], polygon.Next(i), normal);
  return gradient;
}

}  // namespace penumbra
