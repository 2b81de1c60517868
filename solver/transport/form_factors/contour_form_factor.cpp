#include "solver/transport/form_factors/contour_form_factor.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "solver/transport/form_factors/pair_form_factor.h"
#include "solver/transport/links/cubature.h"
#include "solver/visibility/area/kronrod_rule.h"
#include "solver/visibility/pair/tube_blockers.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

constexpr int kPiecesOfEdge = 8;

// The integral of ln r along an edge, where r is the distance from a point [m, for r in m].
double LogAlong(const Vec3& at, const Vec3& begin, const Vec3& along, double length) {
  const Vec3 way = begin - at;
  const double first = way.dot(along);
  const double height = way.cross(along).norm();
  const auto primitive = [&](double s) {
    const double square = s * s + height * height;
    if (square == 0) return 0.0;
    return 0.5 * s * std::log(square) - s + height * std::atan2(s, height);
  };
  return primitive(first + length) - primitive(first);
}

struct ContourIntegral {
  double value = 0, error = 0;  // [m^2]
};

// The double integral along two edges, without the cosine between them. The parameter of the outer edge is
// t^2 (3 - 2 t), which softens the logarithm at ends where the edges meet.
ContourIntegral AlongEdges(const Vec3& begin, const Vec3& end, const Vec3& other, const Vec3& along,
                           double length) {
  double kronrod = 0, gauss = 0;
  for (int piece = 0; piece < kPiecesOfEdge; ++piece)
    for (std::size_t k = 0; k < kFifteen.node.size(); ++k) {
      const double t = (piece + kFifteen.node[k]) / kPiecesOfEdge;
      const Vec3 at = begin + t * t * (3 - 2 * t) * (end - begin);
      const double value = 6 * t * (1 - t) / kPiecesOfEdge * LogAlong(at, other, along, length);
      kronrod += kFifteen.kronrod[k] * value;
      gauss += kFifteen.gauss[k] * value;
    }
  const double scale = (end - begin).norm();
  return {scale * kronrod, scale * std::abs(kronrod - gauss)};
}

// The flux between two areas for unit radiosity, without blockers [m^2].
ContourIntegral AlongContours(std::span<const Vec3> a, std::span<const Vec3> b) {
  ContourIntegral sum;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 &begin = a[i], &end = a[(i + 1) % a.size()];
    const double own = (end - begin).norm();
    for (std::size_t j = 0; j < b.size() && own > 0; ++j) {
      const Vec3 other = b[(j + 1) % b.size()] - b[j];
      const double length = other.norm();
      if (length == 0) continue;
      const double cosine = (end - begin).dot(other) / (own * length);
      if (cosine == 0) continue;
      const ContourIntegral edges = AlongEdges(begin, end, b[j], other / length, length);
      sum.value += cosine * edges.value;
      sum.error += std::abs(cosine) * edges.error;
    }
  }
  return {sum.value / (2 * std::numbers::pi), sum.error / (2 * std::numbers::pi)};
}

// (visible part) / (whole) of the mean point form factor.
double VisiblePart(const SightedPair& pair, int refinement) {
  double visible = 0, whole = 0;
  for (const CubaturePoint& point : Cubature(pair.sender, refinement)) {
    ReceiverPoint at;
    at.position = point.position;
    at.normal = pair.SenderNormal();
    PointView view(pair.scene, at);
    if (!view.FaceSource(pair.target_patch)) continue;
    const DirectionPolygon seen = view.SeeSource(pair.target);
    if (seen.empty()) continue;
    whole += point.weight * FormFactor(seen, at.normal);
    std::vector<Occluder>& occluders = view.occluder_stack();
    if (view.FindBlockers(pair.blockers, pair.sender_patch, seen, occluders))
      visible += point.weight * view.VisibleFormFactor(seen, occluders);
  }
  return whole > 0 ? visible / whole : 0;
}

FormFactorEstimate ByContours(const SightedPair& pair) {
  FormFactorEstimate estimate;
  const auto patch = [&](PatchId id) -> const Patch& {
    return pair.scene.patches[static_cast<std::size_t>(id)];
  };
  const std::optional<TubeEnds> ends =
      ClipToEachOther(pair.sender, patch(pair.sender_patch), pair.target, patch(pair.target_patch));
  if (!ends) return estimate;
  const ContourIntegral flux = AlongContours(ends->receiver, ends->source);
  const double area = VectorArea(pair.sender).norm();
  estimate.factor = flux.value / area;
  estimate.error = flux.error / area;
  if (pair.blockers.empty()) return estimate;
  const double fine = VisiblePart(pair, 1), coarse = VisiblePart(pair, 0);
  estimate.error = fine * estimate.error + std::abs(fine - coarse) * estimate.factor;
  estimate.factor *= fine;
  return estimate;
}

}  // namespace

LinkFormFactorRegistry::Method ContourFormFactorMethod() {
  return {"contour",
          "the contour integral along both boundaries; a mean visible part past blockers (Goral et al. 1984)",
          {},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const PairFormFactor>(ByContours, 0, false, options);
          }};
}

}  // namespace penumbra
