#include "solver/visibility/area/area_form_factor.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/visibility/area/pair_counter.h"
#include "solver/visibility/area/pair_integral.h"
#include "solver/visibility/pair/tube_blockers.h"

namespace penumbra {
namespace {

// Relative tolerance of a first estimate of each pair of many; it shows which pairs need more points.
constexpr double kRoughTolerance = 1e-2;

// If some pairs of many have blockers, the other pairs together may have an error of this fraction of the
// tolerance of all pairs.
constexpr double kShareOfClear = 0.1;

// The smallest point budget of each of many pairs.
constexpr std::size_t kLeastOfMany = 2000;

// A pair whose error is at most this fraction of the error allowed per pair is not refined.
constexpr double kGoodAlready = 0.5;

// Points that lie outside an edge of a triangle by less than this times the extent of the triangle's patch
// count as on the edge. About a hundred times the rounding of a height above a plane.
constexpr double kOnEdge = 1e-13;

double Area(const AreaPart& part) { return VectorArea(part.polygon).norm(); }

// The patches that may stand between two areas, ascending.
void FindBetween(const PatchHierarchy& patches, const TubeEnds& ends, const Patch& receiver,
                 const Patch& source, std::vector<PatchId>& found) {
  Vec3 low = ends.receiver[0], high = low;
  for (const Polygon3* polygon : {&ends.receiver, &ends.source})
    for (const Vec3& v : *polygon) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  ConvexRegion region = {{receiver.normal, receiver.normal.dot(receiver.vertex[0])},
                         {source.normal, source.normal.dot(source.vertex[0])}};
  for (int axis = 0; axis < 3; ++axis) {
    region.push_back({Vec3::Unit(axis), low[axis]});
    region.push_back({-Vec3::Unit(axis), -high[axis]});
  }
  patches.Find(region, {}, found);
}

}  // namespace

std::vector<AreaPart> PartsOfFace(const Scene& scene, std::int32_t face) {
  std::vector<AreaPart> parts;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const Patch& patch = scene.patches[p];
    if (std::find(patch.faces.begin(), patch.faces.end(), face) == patch.faces.end()) continue;
    Polygon3 part(patch.Vertices().begin(), patch.Vertices().end());
    if (patch.faces.size() > 1) {
      // The patch joins two triangles; the face is the part in its own triangle.
      const Polygon3& triangle = scene.faces[static_cast<std::size_t>(face)].vertices;
      for (std::size_t i = 0; i < triangle.size() && !part.empty(); ++i) {
        const Vec3 edge = triangle[(i + 1) % triangle.size()] - triangle[i];
        const Vec3 inwards = patch.normal.cross(edge);
        if (inwards.isZero(0)) continue;
        part = ClipToHalfSpace(part, inwards.normalized(), triangle[i], kOnEdge * patch.extent);
      }
      if (part.empty()) continue;
    }
    parts.push_back({static_cast<PatchId>(p), std::move(part)});
  }
  return parts;
}

FormFactorEstimate AreaFormFactor(const Scene& scene, const PatchHierarchy& patches, const AreaPart& from,
                                  const AreaPart& to, const AreaFormFactorOptions& options) {
  if (from.patch == to.patch) return {};
  const double from_area = Area(from);
  const bool swap = !options.points_on_first && Area(to) < from_area;
  const AreaPart &receiver = swap ? to : from, &source = swap ? from : to;
  const Patch &receiver_patch = scene.patches[static_cast<std::size_t>(receiver.patch)],
              &source_patch = scene.patches[static_cast<std::size_t>(source.patch)];
  std::optional<TubeEnds> ends =
      ClipToEachOther(receiver.polygon, receiver_patch, source.polygon, source_patch);
  if (!ends) return {};
  std::vector<PatchId> found, blockers;
  FindBetween(patches, *ends, receiver_patch, source_patch, found);
  if (!FindTubeBlockers(scene, *ends, receiver.patch, source.patch, found, blockers)) return {};
  const PartPair pair = {receiver.patch, source.patch, std::move(*ends), from_area};
  const FormFactorEstimate integral = IntegratePair(scene, pair, std::move(blockers), options);
  return {integral.factor / from_area, integral.error / from_area, integral.clear, integral.points};
}

namespace {

// All pairs of parts from two lists.
class PairsOfParts {
 public:
  PairsOfParts(const Scene& scene, std::span<const AreaPart> from, std::span<const AreaPart> to)
      : scene_(scene), from_(from), to_(to), pairs_(from.size() * to.size()) {
    std::vector<PatchId> all(scene.patches.size());
    std::iota(all.begin(), all.end(), 0);
    patches_ = PatchHierarchy(scene, std::move(all));
    for (const AreaPart& part : from) area_ += Area(part);
  }

  std::size_t Count() const { return pairs_.size(); }
  std::vector<std::size_t> All() const {
    std::vector<std::size_t> all(Count());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }

  void Solve(const char* phase, std::span<const std::size_t> which, const AreaFormFactorOptions& how) {
    PairCounter counter(how.context, phase, which.size());
    ParallelFor(which.size(), 1, [&](std::size_t i) {
      if (how.context && how.context->Cancelled()) return;
      const std::size_t k = which[i];
      pairs_[k] = AreaFormFactor(scene_, patches_, from_[k / to_.size()], to_[k % to_.size()], how);
      counter.Add();
    });
  }

  // Recomputes the pairs with the largest errors among the pairs without blockers (`clear`) or those with
  // blockers, so that the flux errors of these pairs add up to at most area_ * error.
  void Refine(bool clear, double error, const AreaFormFactorOptions& options) {
    const double asked = area_ * error;
    std::vector<std::size_t> which;
    double now = 0;
    for (std::size_t k = 0; k < Count(); ++k) {
      if (pairs_[k].clear != clear) continue;
      which.push_back(k);
      now += FluxError(k);
    }
    if (now <= asked) return;
    const double share = kGoodAlready * asked / static_cast<double>(which.size());
    std::erase_if(which, [&](std::size_t k) { return FluxError(k) <= share; });
    AreaFormFactorOptions fine = options;
    fine.tolerance = fine.clear_tolerance = 0;
    fine.sufficient_error = asked / static_cast<double>(2 * which.size());
    fine.small_error = options.small_error / static_cast<double>(which.size());
    fine.sufficient_points = std::max(kLeastOfMany, options.sufficient_points / which.size());
    Solve("integrate", which, fine);
  }

  bool AllClear() const {
    return std::all_of(pairs_.begin(), pairs_.end(),
                       [](const FormFactorEstimate& pair) { return pair.clear || pair.error == 0; });
  }

  FormFactorEstimate Sum() const {
    FormFactorEstimate sum;
    if (area_ == 0) return sum;
    for (std::size_t k = 0; k < Count(); ++k) {
      const double weight = Area(from_[k / to_.size()]);
      sum.factor += weight * pairs_[k].factor;
      sum.error += weight * pairs_[k].error;
      sum.points += pairs_[k].points;
    }
    sum.factor /= area_;
    sum.error /= area_;
    sum.clear = AllClear();
    return sum;
  }

 private:
  double FluxError(std::size_t k) const { return Area(from_[k / to_.size()]) * pairs_[k].error; }

  const Scene& scene_;
  std::span<const AreaPart> from_, to_;
  PatchHierarchy patches_;
  double area_ = 0;  // of the parts of the first list [m^2]
  std::vector<FormFactorEstimate> pairs_;
};

}  // namespace

FormFactorEstimate AreaFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const AreaFormFactorOptions& options) {
  if (from.empty() || to.empty()) return {};
  PairsOfParts pairs(scene, from, to);
  if (pairs.Count() == 1) {
    AreaFormFactorOptions alone = options;
    alone.reports_progress = true;
    pairs.Solve("integrate", pairs.All(), alone);
  } else {
    // First a rough estimate of all pairs; then each pair as exactly as the sum requires.
    AreaFormFactorOptions rough = options;
    rough.tolerance = std::max(options.tolerance, kRoughTolerance);
    rough.clear_tolerance = std::max(options.clear_tolerance, kRoughTolerance);
    pairs.Solve("estimate", pairs.All(), rough);
    const double factor = pairs.Sum().factor, whole = AllowedError(factor, options.tolerance);
    const double of_clear =
        std::max(AllowedError(factor, options.clear_tolerance), pairs.AllClear() ? 0 : kShareOfClear * whole);
    pairs.Refine(/*clear=*/true, of_clear, options);
    pairs.Refine(/*clear=*/false, whole, options);
  }
  return pairs.Sum();
}

}  // namespace penumbra
