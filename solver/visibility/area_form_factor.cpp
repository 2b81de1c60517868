#include "solver/visibility/area_form_factor.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/visibility/pair_integral.h"
#include "solver/visibility/tube_blockers.h"

namespace penumbra {
namespace {

// Of many pairs, each is known this well before it is decided which deserve more.
constexpr double kRoughTolerance = 1e-2;

// Where some pairs of many are blocked, the others together need not err by less than this share of what
// those may.
constexpr double kShareOfClear = 0.1;

// Points that each of many pairs may cost at least.
constexpr std::size_t kLeastOfMany = 2000;

// Counts pairs from several threads, and tells the context.
class PairCounter {
 public:
  PairCounter(const ExecutionContext* context, const char* phase, std::size_t pairs)
      : context_(context), phase_(phase), pairs_(pairs) {}

  void Add() {
    if (!context_) return;
    const std::lock_guard lock(mutex_);
    context_->Report(phase_, static_cast<double>(++done_) / static_cast<double>(pairs_));
  }

 private:
  const ExecutionContext* context_;
  const char* phase_;
  std::size_t pairs_, done_ = 0;
  std::mutex mutex_;
};

double Area(const AreaPart& part) { return VectorArea(part.polygon).norm(); }

// What may stand between two areas, ascending.
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
      // Two triangles were joined: this one's share is what lies in it.
      const Polygon3& triangle = scene.faces[static_cast<std::size_t>(face)].vertices;
      for (std::size_t i = 0; i < triangle.size() && !part.empty(); ++i) {
        const Vec3 edge = triangle[(i + 1) % triangle.size()] - triangle[i];
        const Vec3 inwards = patch.normal.cross(edge);
        if (inwards.isZero(0)) continue;
        part = ClipToHalfSpace(part, inwards.normalized(), triangle[i], 1e-13 * patch.extent);
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

FormFactorEstimate AreaFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const AreaFormFactorOptions& options) {
  if (from.empty() || to.empty()) return {};
  std::vector<PatchId> all(scene.patches.size());
  std::iota(all.begin(), all.end(), 0);
  const PatchHierarchy patches(scene, std::move(all));
  std::vector<FormFactorEstimate> pairs(from.size() * to.size());
  const auto flux_error = [&](std::size_t k) { return Area(from[k / to.size()]) * pairs[k].error; };
  const auto solve = [&](const char* phase, std::span<const std::size_t> which,
                         const AreaFormFactorOptions& how) {
    PairCounter counter(how.context, phase, which.size());
    ParallelFor(which.size(), 1, [&](std::size_t i) {
      if (how.context && how.context->Cancelled()) return;
      const std::size_t k = which[i];
      pairs[k] = AreaFormFactor(scene, patches, from[k / to.size()], to[k % to.size()], how);
      counter.Add();
    });
  };
  std::vector<std::size_t> which(pairs.size());
  std::iota(which.begin(), which.end(), std::size_t{0});
  if (pairs.size() == 1) {
    AreaFormFactorOptions alone = options;
    alone.tells = true;
    solve("integrate", which, alone);
  } else {
    // First as well as is cheap, then those that matter as well as matters for the sum.
    AreaFormFactorOptions rough = options;
    rough.tolerance = std::max(options.tolerance, kRoughTolerance);
    rough.clear_tolerance = std::max(options.clear_tolerance, kRoughTolerance);
    solve("estimate", which, rough);
    double flux = 0, area = 0;
    for (const AreaPart& part : from) area += Area(part);
    for (std::size_t k = 0; k < pairs.size(); ++k) flux += Area(from[k / to.size()]) * pairs[k].factor;
    const double whole = area * AllowedError(flux / area, options.tolerance);
    const bool all_clear = std::all_of(pairs.begin(), pairs.end(),
                                       [](const auto& pair) { return pair.clear || pair.error == 0; });
    for (const bool clear : {true, false}) {
      double asked = whole;
      if (clear)
        asked = std::max(area * AllowedError(flux / area, options.clear_tolerance),
                         all_clear ? 0 : kShareOfClear * whole);
      std::vector<std::size_t> kind;
      double error = 0;
      for (const std::size_t k : which) {
        if (pairs[k].clear != clear) continue;
        kind.push_back(k);
        error += flux_error(k);
      }
      if (error <= asked) continue;
      const double share = 0.5 * asked / static_cast<double>(kind.size());
      std::erase_if(kind, [&](std::size_t k) { return flux_error(k) <= share; });
      AreaFormFactorOptions fine = options;
      fine.tolerance = fine.clear_tolerance = 0;
      fine.enough = asked / static_cast<double>(2 * kind.size());
      fine.small = options.small / static_cast<double>(kind.size());
      fine.enough_points = std::max(kLeastOfMany, options.enough_points / kind.size());
      solve("integrate", kind, fine);
    }
  }
  const bool all_clear = std::all_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair.clear; });
  double area = 0;
  FormFactorEstimate sum;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double weight = Area(from[i]);
    area += weight;
    for (std::size_t j = 0; j < to.size(); ++j) {
      sum.factor += weight * pairs[i * to.size() + j].factor;
      sum.error += weight * pairs[i * to.size() + j].error;
      sum.points += pairs[i * to.size() + j].points;
    }
  }
  if (area == 0) return {};
  sum.factor /= area;
  sum.error /= area;
  sum.clear = all_clear;
  return sum;
}

}  // namespace penumbra
