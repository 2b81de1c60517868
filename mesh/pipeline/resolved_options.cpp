// Options that follow from the requested error.

#include <algorithm>
#include <cmath>

#include "mesh/discontinuities/discontinuity_choices.h"
#include "mesh/pipeline/option_table.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene_parts.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/refinement_oracles.h"
#include "solver/transport/points/mean_free_path.h"
#include "solver/transport/solvers/light_solvers.h"
#include "solver/visibility/exact/occlusion_methods.h"

namespace penumbra {
namespace {

// Factors of options that follow from the requested error, measured on closed boxes and furnished rooms. With
// these factors, the 99th percentile stays at or below the requested error where weak discontinuities do not
// limit the interpolants.
constexpr double kEpsOfMeanIrradiance = 2;  // eps = this x error x mean irradiance
constexpr double kWeightOfStrongest = 5;    // minimum weight = this x error x largest emittance, at most ...
constexpr double kLargestWeight = 0.25;     // ... this x largest emittance
// With the irradiance weight: the allowed cost of an omitted edge, root mean square over leaves that also
// lack other edges, as a fraction of error x mean irradiance.
constexpr double kWeightOfMeanIrradiance = 0.15;
// The weight of the lightest discontinuity that representation-based refinement may request, as the same
// fraction.
constexpr double kWantedWeight = 0.05;
// The area of the smallest leaf, as a fraction of the fronts' total area. Under a sky or on a plain it would
// be larger than a table: parts of the scene (PartsOf) whose error is measured may need smaller leaves, down
// to a fraction of the part. The last fraction, of the total area, holds for parts that are tiny.
constexpr double kMinAreaOfScene = 1e-7, kMinAreaOfPart = 1e-3, kMinAreaOfTinyPart = 1e-10;
constexpr double kCutoffOfError = 0.005;
constexpr double kCorrectionOfError = 0.04;  // SolverOptions::correction_tolerance
// With representation-based refinement alone, links are refined to this times the eps of transport-based
// refinement.
constexpr double kCoarseEps = 4;

// Scenes with more patches are solved by sampling unless the user says otherwise. Where a loose error is
// asked for, kLooseError or more, sampling pays earlier.
constexpr std::size_t kMostPatchesOfPairs = 400, kMostPatchesIfLoose = 150;
constexpr double kLooseError = 0.05;
// The error for which the defaults of SampledOptions suffice.
constexpr double kSampledError = 0.1;
// The side of the largest element of the sampled solver, and of the smallest leaf of its mesh, at this error:
// as fractions of the mean free path, the size of a typical room. Their areas are proportional to the error.
// Without edges along shadows, leaves there become as small as they may.
constexpr double kSideOfSampled = 0.07, kLeastSideOfSampled = 0.008;
constexpr std::size_t kMostElements = 4'000'000;
// The distance between the points that look for shadows which the mesh misses, as a fraction of the mean free
// path.
constexpr double kLookoutDistance = 0.25;
constexpr std::size_t kMostLookouts = 200'000;

struct SceneTotals {
  double area = 0, flux = 0, reflectance = 0, strongest = 0;  // of the brightest channel
  double free_path = 0;                                       // MeanFreePath(), only if solved by sampling
};

SceneTotals Total(const Scene& scene) {
  SceneTotals totals;
  Rgb flux = Rgb::Zero(), reflectance = Rgb::Zero();
  for (const Patch& patch : scene.patches) {
    const Material& material = scene.materials[patch.material];
    totals.area += patch.area;
    flux += patch.area * material.emittance;
    reflectance += patch.area * material.reflectance;
    totals.strongest = std::max(totals.strongest, material.emittance.maxCoeff());
  }
  int channel = 0;
  totals.flux = flux.maxCoeff(&channel);
  if (totals.area > 0) totals.reflectance = reflectance[channel] / totals.area;
  return totals;
}

double LeastArea(const Scene& scene, double total) {
  const std::vector<double> seen = ReflectingAreas(scene);
  double least = kMinAreaOfScene * total;
  for (const ScenePart& part : PartsOf(scene)) {
    double area = 0;
    for (const PatchId patch : part.patches) area += seen[static_cast<std::size_t>(patch)];
    if (area > 0) least = std::min(least, kMinAreaOfPart * area);
  }
  return std::max(least, kMinAreaOfTinyPart * total);
}

// The options of the sampled solver for the requested error.
SampledOptions SamplingFor(const SceneTotals& totals, const PipelineOptions& options) {
  SampledOptions sampled;
  const double finer = kSampledError / options.error;  // than the settings' defaults
  const auto scaled = [&](std::size_t number, double power, std::size_t least, std::size_t most) {
    const double value = static_cast<double>(number) * std::pow(finer, power);
    return static_cast<std::size_t>(std::clamp(value, static_cast<double>(least), static_cast<double>(most)));
  };
  if (totals.free_path > 0) {
    const double side = kSideOfSampled * totals.free_path;
    sampled.elements = static_cast<std::size_t>(
        std::clamp(totals.area / (side * side) * finer, 2'000.0, static_cast<double>(kMostElements)));
  }
  sampled.relative_spread = std::clamp(sampled.relative_spread / std::sqrt(finer), 0.02, 0.5);
  sampled.element_rays = scaled(sampled.element_rays, 0.5, 32, 1024);
  sampled.point_rays = options.rays > 0 ? options.rays : scaled(sampled.point_rays, 1.5, 64, 65'536);
  sampled.relative_cutoff = options.relative_cutoff.value_or(kCutoffOfError * options.error);
  return sampled;
}

// The options of solvers on uniform meshes: those of links as for the hierarchical solver.
UniformOptions UniformFor(const SolverOptions& links, const PipelineOptions& options) {
  UniformOptions uniform;
  uniform.divisions = options.dense.divisions;
  uniform.form_factors = links.form_factors;
  uniform.form_factor_options = links.form_factor_options;
  uniform.form_factor_options.factors_only = true;
  uniform.scheme = options.scheme;
  uniform.relative_cutoff = links.relative_cutoff;
  uniform.shots = options.shots;
  uniform.overshoot = options.overshoot;
  uniform.ambient = options.ambient;
  return uniform;
}

}  // namespace

std::string SolverFor(const Scene& scene, const PipelineOptions& options) {
  if (options.solver) return *options.solver;
  const std::size_t most = options.error < kLooseError ? kMostPatchesOfPairs : kMostPatchesIfLoose;
  if (scene.patches.size() <= most) return "hierarchical";
  const PipelineOptions defaults;
  for (const SolveOption& option : OptionTable())
    if (option.solver == "hierarchical" && option.field.get(options) != option.field.get(defaults))
      return "hierarchical";
  return "sampled";
}

ResolvedOptions Resolve(const Scene& scene, const PipelineOptions& options) {
  SceneTotals totals = Total(scene);
  // The mean irradiance if no light escapes and the light spreads evenly.
  const double mean = totals.area > 0 ? totals.flux / totals.area / (1 - totals.reflectance) : 0;
  ResolvedOptions resolved;
  resolved.solver_name = LightSolvers().Find(SolverFor(scene, options)).name;
  const bool is_sampled = resolved.solver_name == "sampled";
  if (is_sampled) totals.free_path = MeanFreePath(scene);
  resolved.sampled = SamplingFor(totals, options);
  const double coarse = options.refine == RefineBy::kRepresentation ? kCoarseEps : 1;
  resolved.solver.eps = options.eps.value_or(coarse * kEpsOfMeanIrradiance * options.error * mean);
  const double side = kLeastSideOfSampled * totals.free_path;
  const double least =
      is_sampled ? side * side * std::min(1.0, options.error / kSampledError) : LeastArea(scene, totals.area);
  resolved.solver.min_area = options.min_area.value_or(least);
  if (totals.free_path > 0) {
    const double distance = kLookoutDistance * totals.free_path;
    resolved.lookouts = static_cast<std::size_t>(
        std::min(totals.area / (distance * distance), static_cast<double>(kMostLookouts)));
  }
  resolved.solver.relative_cutoff = options.relative_cutoff.value_or(kCutoffOfError * options.error);
  resolved.solver.max_iterations = options.max_iterations;
  resolved.solver.max_corrections = options.max_corrections;
  resolved.solver.correction_tolerance = kCorrectionOfError * options.error;
  resolved.solver.source_error = options.source_error.value_or(0);
  resolved.solver.form_factors = LinkFormFactorMethods().Find(options.form_factors).name;
  resolved.solver.form_factor_options.resolution = options.resolution;
  resolved.solver.form_factor_options.rays = options.rays;
  resolved.solver.form_factor_options.seed = options.seed;
  resolved.occlusion = MakeOcclusion(options.method, {options.point.min_backprojection_segment});
  resolved.solver.occlusion = resolved.occlusion;
  resolved.solver.form_factor_options.occlusion = resolved.occlusion;
  resolved.solver.scheme = options.scheme;
  resolved.solver.acceleration = options.acceleration;
  resolved.solver.oracle = RefinementOracles().Find(options.oracle).name;
  resolved.solver.multigrid = options.multigrid;
  resolved.uniform = UniformFor(resolved.solver, options);
  resolved.refine_light = options.refine != RefineBy::kTransport && !options.source_error;
  resolved.solver.last_correction_elsewhere = resolved.refine_light;
  DiscontinuityOptions& mesh = resolved.discontinuities;
  mesh.choice = DiscontinuityChoices().Find(options.discontinuities).name;
  mesh.weight = options.weight.value_or(options.min_discontinuity_weight ? DiscontinuityWeight::kThesis
                                                                         : DiscontinuityWeight::kIrradiance);
  const double from_error =
      mesh.weight == DiscontinuityWeight::kThesis
          ? std::min(kLargestWeight, kWeightOfStrongest * options.error) * totals.strongest
          : kWeightOfMeanIrradiance * options.error * mean;
  mesh.min_weight = options.min_discontinuity_weight.value_or(from_error);
  const bool may_ask = !options.min_discontinuity_weight && mesh.weight == DiscontinuityWeight::kIrradiance;
  mesh.min_wanted_weight =
      options.min_wanted_weight.value_or(may_ask ? kWantedWeight * options.error * mean : mesh.min_weight);
  mesh.corner_divisions = options.corner_divisions;
  mesh.max_leaf_dsets = options.max_leaf_dsets;
  mesh.keep_hidden = options.keep_hidden_discontinuities;
  mesh.triple_edge_tolerance = options.triple_edge_tolerance;
  mesh.seed = options.seed;
  mesh.crowded_splits = options.crowded_splits;
  mesh.min_split_area = resolved.solver.min_area;
  return resolved;
}

}  // namespace penumbra
