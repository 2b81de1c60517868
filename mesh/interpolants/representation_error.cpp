#include "mesh/interpolants/representation_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "mesh/interpolants/mesh_locator.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/scene/scene_parts.h"
#include "solver/visibility/point/enclosure.h"

namespace penumbra {
namespace {

constexpr std::size_t kPointsATask = 16;
// Additional points in each part of the scene: kPartPoints, but at most kAllPartPoints for all parts
// together, and at least kFewestPartPoints. A part whose error seems too large gets kPointsToTellAPart more,
// because the result for few points may be an accident; if there are many such parts, they share
// kAllSuspectPoints, but get at least kFewestSuspectPoints.
constexpr std::size_t kPartPoints = 20, kAllPartPoints = 160, kFewestPartPoints = 4;
constexpr std::size_t kAllSuspectPoints = 6000, kFewestSuspectPoints = 12;

// Errors count only beyond this many standard errors of the truth, as in comparisons with path tracing.
constexpr double kSurelyDifferent = 2;

// The fractions of values below and above the 99th percentile.
constexpr double kP99 = 0.99, kAboveP99 = 0.01;

// The values at the points of a measurement.
struct Values {
  std::vector<SurfacePoint> at;
  std::vector<Rgb> shown, exact;             // [W/m^2]
  std::vector<Rgb> exact_deviation;          // of `exact`
  std::vector<std::vector<Rgb>> truths;      // from each of the better samplers
  std::vector<std::vector<Rgb>> deviations;  // of the truths

  // Calls visit(list) for every list that has an entry for each point.
  void ForEachList(const auto& visit) {
    visit(at);
    visit(shown);
    visit(exact);
    visit(exact_deviation);
    for (std::vector<Rgb>& truth : truths) visit(truth);
    for (std::vector<Rgb>& deviation : deviations) visit(deviation);
  }
};

// Appends the values at additional points.
void Evaluate(const Scene& scene, const IrradianceMesh& mesh, const IrradianceSampler& sampler,
              std::span<const IrradianceSampler> better, std::span<const SurfacePoint> points,
              Values& values) {
  const MeshLocator locator(scene, mesh);
  const std::size_t before = values.at.size();
  values.at.insert(values.at.end(), points.begin(), points.end());
  values.shown.resize(values.at.size());
  values.exact.resize(values.at.size());
  values.exact_deviation.resize(values.at.size());
  values.truths.resize(better.size());
  values.deviations.resize(better.size());
  for (std::vector<Rgb>& truth : values.truths) truth.resize(values.at.size());
  for (std::vector<Rgb>& deviation : values.deviations) deviation.resize(values.at.size());
  std::vector<PatchPoint> receivers(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    receivers[p].patch = points[p].patch;
    receivers[p].at.position = points[p].position;
    receivers[p].at.normal = scene.patches[static_cast<std::size_t>(points[p].patch)].normal;
  }
  std::vector<PointIrradianceResult> found(points.size());
  const auto sample = [&](const IrradianceSampler& with, std::vector<Rgb>& of, std::vector<Rgb>& deviation) {
    with.SampleAll(receivers, found);
    for (std::size_t p = 0; p < found.size(); ++p) {
      of[before + p] = found[p].irradiance;
      deviation[before + p] = found[p].deviation;
    }
  };
  sample(sampler, values.exact, values.exact_deviation);
  for (std::size_t k = 0; k < better.size(); ++k) sample(better[k], values.truths[k], values.deviations[k]);
  ParallelFor(points.size(), kPointsATask, [&](std::size_t p) {
    const std::size_t i = before + p;
    const SurfacePoint& at = values.at[i];
    // A face that is narrower than the mesh's resolution shows nothing, and counts as exact.
    const auto place = locator.Find(at.patch, at.position);
    values.shown[i] = place ? Rgb(IrradianceAt(mesh, *place).max(0.0)) : values.exact[i];
  });
}

// Removes the values of dark points that nobody can see, from the given one on.
void DropEnclosed(const Scene& scene, const Enclosure& enclosure, std::size_t begin, Values& values) {
  const Rgb no_light = NoLight(scene);
  std::size_t kept = begin;
  for (std::size_t i = begin; i < values.at.size(); ++i) {
    const SurfacePoint& at = values.at[i];
    const Vec3& normal = scene.patches[static_cast<std::size_t>(at.patch)].normal;
    if ((values.exact[i] <= no_light).all() && enclosure.Surrounds(at.position, normal)) continue;
    values.ForEachList([&](auto& list) { list[kept] = list[i]; });
    ++kept;
  }
  values.ForEachList([&](auto& list) { list.resize(kept); });
}

// Statistics of the errors of values at these points.
RepresentationError Summarise(const Scene& scene, std::span<const SurfacePoint> at,
                              std::span<const ValueError> errors) {
  RepresentationError error;
  if (errors.empty()) return error;
  double squares = 0;
  for (const ValueError& value : errors) {
    squares += value.error * value.error;
    if (value.error <= error.max) continue;
    error.max = value.error;
    error.worst_point = at[value.point].position;
    error.worst_face = scene.FaceAt(at[value.point].patch, error.worst_point);
  }
  error.points = 1;
  for (std::size_t i = 1; i < errors.size(); ++i)
    error.points += errors[i].point != errors[i - 1].point ? 1 : 0;
  error.p99 = Quantile(errors, kP99);
  const double deviation = std::sqrt(kP99 * kAboveP99 / static_cast<double>(error.points));
  error.p99_at_most = Quantile(errors, std::min(kP99 + deviation, 1.0));
  error.p99_at_least =
      Quantile(errors, std::max(0.0, kP99 - deviation - 1 / static_cast<double>(error.points)));
  error.p95 = Quantile(errors, 0.95);
  error.rms = std::sqrt(squares / static_cast<double>(errors.size()));
  return error;
}

// The errors of the first values against a truth. Of each difference, only the part beyond kSurelyDifferent
// standard errors of the truth counts.
std::vector<ValueError> ErrorsBeyondNoise(const Scene& scene, std::span<const SurfacePoint> at,
                                          std::span<const Rgb> shown, std::span<const Rgb> truth,
                                          std::span<const Rgb> deviation) {
  std::vector<Rgb> nearest;
  nearest.reserve(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Rgb noise = kSurelyDifferent * deviation[i];
    nearest.push_back(shown[i].max(truth[i] - noise).min(truth[i] + noise));
  }
  return SeenErrors(scene, at, shown, nearest);
}

// Replaces each error in `largest` by the larger of the two lists' errors. `largest` may be empty initially.
void KeepLarger(const std::vector<ValueError>& errors, std::vector<ValueError>& largest) {
  if (largest.empty()) largest = errors;
  for (std::size_t i = 0; i < errors.size(); ++i)
    largest[i].error = std::max(largest[i].error, errors[i].error);
}

// `count` random points in a part of the scene; none if the part is not seen.
std::vector<SurfacePoint> SpreadOverPart(const Scene& scene, std::span<const double> areas,
                                         const ScenePart& part, std::size_t count, std::uint64_t seed) {
  std::vector<double> weights;
  double total = 0;
  for (const PatchId p : part.patches) total += weights.emplace_back(areas[static_cast<std::size_t>(p)]);
  if (total == 0) return {};
  return SpreadPoints(scene, part.patches, weights, count,
                      seed + 1 + static_cast<std::uint64_t>(part.patches[0]));
}

// Groups the errors by the parts that contain their points, without parts that contain none.
std::vector<PartError> SummariseParts(const Scene& scene, std::span<const ScenePart> parts,
                                      std::span<const SurfacePoint> at, std::span<const ValueError> errors) {
  std::vector<std::size_t> part_of(scene.patches.size());
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const PatchId p : parts[k].patches) part_of[static_cast<std::size_t>(p)] = k;
  std::vector<std::vector<ValueError>> own(parts.size());
  for (const ValueError& value : errors)
    own[part_of[static_cast<std::size_t>(at[value.point].patch)]].push_back(value);
  std::vector<PartError> by_part;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (!own[k].empty()) by_part.push_back({parts[k].name, k, Summarise(scene, at, own[k])});
  return by_part;
}

// Measures each part at the existing points and at additional points, whose values `evaluate` appends.
std::vector<PartError> MeasureParts(const Scene& scene,
                                    const std::function<void(std::span<const SurfacePoint>)>& evaluate,
                                    std::uint64_t seed, double bound, const Values& values) {
  const std::vector<ScenePart> parts = PartsOf(scene);
  const std::vector<double> areas = ReflectingAreas(scene);
  const auto summarise = [&] {
    std::vector<ValueError> errors;
    for (std::size_t k = 0; k < values.truths.size(); ++k)
      KeepLarger(ErrorsBeyondNoise(scene, values.at, values.shown, values.truths[k], values.deviations[k]),
                 errors);
    return SummariseParts(scene, parts, values.at, errors);
  };
  if (parts.size() < 2) return summarise();
  const std::size_t count = std::clamp(kAllPartPoints / parts.size(), kFewestPartPoints, kPartPoints);
  std::vector<SurfacePoint> points;
  const auto add = [&](const ScenePart& part, std::size_t so_many, std::uint64_t with_seed) {
    const std::vector<SurfacePoint> own = SpreadOverPart(scene, areas, part, so_many, with_seed);
    points.insert(points.end(), own.begin(), own.end());
  };
  for (const ScenePart& part : parts) add(part, count, seed);
  evaluate(points);
  const std::vector<PartError> first = summarise();
  points.clear();
  std::vector<std::size_t> suspects;
  for (const PartError& part : first)
    if (part.whole.p99 > bound) suspects.push_back(part.part);
  if (suspects.empty()) return first;
  const std::size_t more =
      std::clamp(kAllSuspectPoints / suspects.size(), kFewestSuspectPoints, kPointsToTellAPart);
  for (const std::size_t part : suspects) add(parts[part], more, seed + 1);
  evaluate(points);
  return summarise();
}

}  // namespace

Rgb NoLight(const Scene& scene) {
  constexpr double kRounding = 1e-10;
  double strongest = 0;
  for (const Patch& patch : scene.patches)
    strongest = std::max(strongest, scene.materials[patch.material].emittance.maxCoeff());
  return Rgb::Constant(kRounding * strongest);
}

std::vector<double> RelativeErrors(std::span<const Rgb> shown, std::span<const Rgb> truth, const Rgb& least) {
  Rgb mean = Rgb::Zero();
  for (const Rgb& e : truth) mean += e / static_cast<double>(truth.size());
  mean = mean.max(least / kErrorFloor);
  std::vector<double> errors;
  errors.reserve(3 * truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double difference = std::abs(shown[i][c] - truth[i][c]);
      errors.push_back(difference == 0 ? 0 : difference / std::max(truth[i][c], kErrorFloor * mean[c]));
    }
  return errors;
}

double Quantile(std::vector<double> values, double q) {
  PENUMBRA_CHECK(!values.empty());
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::vector<ValueError> SeenErrors(const Scene& scene, std::span<const SurfacePoint> at,
                                   std::span<const Rgb> shown, std::span<const Rgb> truth) {
  const std::vector<std::array<bool, 3>> seen = ReflectingChannels(scene);
  const std::vector<double> all = RelativeErrors(shown, truth, NoLight(scene));
  std::vector<ValueError> errors;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (seen[static_cast<std::size_t>(at[i / 3].patch)][i % 3]) errors.push_back({all[i], i / 3});
  return errors;
}

double Quantile(std::span<const ValueError> values, double q) {
  if (values.empty()) return 0;
  std::vector<double> errors;
  for (const ValueError& value : values) errors.push_back(value.error);
  return Quantile(std::move(errors), q);
}

MeasuredError MeasureError(const Scene& scene, const IrradianceMesh& mesh, const IrradianceSampler& sampler,
                           std::span<const IrradianceSampler> better, const ErrorMeasurement& measurement) {
  const auto [points, seed, bound] = measurement;
  MeasuredError error;
  if (scene.patches.empty() || points == 0) return error;
  const std::vector<double> areas = ReflectingAreas(scene);
  const Enclosure enclosure(scene);
  Values values;
  const auto evaluate = [&](std::span<const SurfacePoint> at) {
    const std::size_t before = values.at.size();
    Evaluate(scene, mesh, sampler, better, at, values);
    DropEnclosed(scene, enclosure, before, values);
  };
  evaluate(SpreadPoints(scene, areas, points, seed));
  // The first points, which are distributed uniformly, determine means and all statistics except those of
  // parts.
  const std::vector<SurfacePoint> evenly = values.at;
  error.interpolant = Summarise(
      scene, evenly, ErrorsBeyondNoise(scene, evenly, values.shown, values.exact, values.exact_deviation));
  if (better.empty()) return error;
  std::vector<ValueError> sources, whole;
  for (std::size_t k = 0; k < values.truths.size(); ++k) {
    KeepLarger(ErrorsBeyondNoise(scene, evenly, values.exact, values.truths[k], values.deviations[k]),
               sources);
    KeepLarger(ErrorsBeyondNoise(scene, evenly, values.shown, values.truths[k], values.deviations[k]), whole);
  }
  error.sources = Summarise(scene, evenly, sources);
  error.whole = Summarise(scene, evenly, whole);
  error.above = static_cast<double>(std::count_if(whole.begin(), whole.end(),
                                                  [&](const ValueError& e) { return e.error > bound; })) /
                static_cast<double>(std::max<std::size_t>(1, whole.size()));
  error.by_part = MeasureParts(scene, evaluate, seed, kPartError * bound, values);
  return error;
}

RepresentationError MeasureRepresentationError(const Scene& scene, const IrradianceMesh& mesh,
                                               const IrradianceSampler& sampler, std::size_t points,
                                               std::uint64_t seed) {
  return MeasureError(scene, mesh, sampler, {}, {points, seed, 0}).interpolant;
}

}  // namespace penumbra
