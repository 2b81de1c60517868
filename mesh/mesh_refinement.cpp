#include "mesh/mesh_refinement.h"

#include <algorithm>
#include <optional>

#include "mesh/local_pass.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"

namespace penumbra {
namespace {

// Triangles whose gradients jump by less than what leads to this share of the error asked for are not
// measured.
constexpr double kSuspicion = 0.3;
// Beyond this, a triangle that was found good is looked at once more, at finer points.
constexpr double kDoubt = 1;
// What halving the size makes of the error where the irradiance is smooth.
constexpr double kSmoothGain = 8;

// A leaf with triangles that err by too much.
struct Candidate {
  ElementId leaf = kNoElement;
  double area_above = 0;  // [m^2]
  double gain = 0;        // area that dividing it is expected to mend, per triangle that it costs [m^2]
  double mended = 0;      // [m^2]
};

std::vector<Candidate> FindCandidates(const RefinedMesh& refined, double error) {
  std::vector<Candidate> candidates;
  std::size_t base = 0;
  for (const PatchTriangulation& patch : refined.triangulations) {
    for (std::size_t i = 0; i < patch.leaves.size(); ++i) {
      Candidate candidate;
      candidate.leaf = patch.leaves[i];
      // A leaf that was crowded has been split for the triangulation.
      const std::size_t first = i;
      while (i + 1 < patch.leaves.size() && patch.leaves[i + 1] == candidate.leaf) ++i;
      for (std::size_t t = patch.first_triangle[first]; t < patch.first_triangle[i + 1]; ++t) {
        const double e = refined.errors[base + t].max;
        if (e <= error) continue;
        const auto& v = patch.triangles[t].vertex;
        const Vec2 &a = patch.in_plane[v[0]], &b = patch.in_plane[v[1]], &c = patch.in_plane[v[2]];
        const double area = 0.5 * Cross2(b - a, c - a);
        candidate.area_above += area;
        // What is not mended at once is mended on half the area.
        candidate.mended += e <= kSmoothGain * error ? area : 0.5 * area;
      }
      if (candidate.area_above == 0) continue;
      candidate.gain = candidate.mended / (patch.first_triangle[i + 1] - patch.first_triangle[first] + 6);
      candidates.push_back(candidate);
    }
    base += patch.triangles.size();
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  return candidates;
}

}  // namespace

RefinedMesh RefineMesh(const PatchVisibility& visibility, const RadiositySolution& solution,
                       const IrradianceSampler& sampler, const MeshOptions& mesh_options,
                       const MeshRefinementOptions& options, const ExecutionContext& context,
                       LocalPassCache* local_pass, const ElementForest* start, SampleCache* samples) {
  PENUMBRA_CHECK(mesh_options.order != InterpolantOrder::kConstant);
  const Scene& scene = solution.forest.scene();
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  SampleCache own_samples;
  if (!samples) samples = &own_samples;
  std::optional<LocalPassCache> own;
  if (!local_pass) local_pass = &own.emplace(scene, visibility);
  RefinedMesh refined;
  refined.forest = start ? *start : solution.forest;
  MeshReport::Seconds seconds;
  std::size_t evaluations = 0;
  for (int round = 0;; ++round) {
    refined.report = {};
    refined.triangulations =
        TriangulatePatches(visibility, solution, refined.forest, mesh_options.discontinuities, context,
                           refined.report, local_pass);
    seconds.discontinuities += refined.report.seconds.discontinuities;
    seconds.triangulate += refined.report.seconds.triangulate;
    const Stopwatch interpolating;
    if (context.Cancelled()) return {};
    BuiltMesh built =
        BuildIrradianceMesh(scene, refined.triangulations, mesh_options.order, sampler, context, samples);
    if (context.Cancelled()) return {};
    refined.mesh = std::move(built.mesh);
    evaluations += built.point_evaluations;

    const Rgb mean = MeanIrradiance(refined.mesh);
    const std::vector<double> guess = GuessTriangleErrors(scene, refined.mesh, mean);
    std::vector<std::uint32_t> suspects;
    for (std::uint32_t t = 0; t < guess.size(); ++t)
      if (guess[t] > kSuspicion * options.error) suspects.push_back(t);
    MeasuredTriangles measured =
        MeasureTriangles(scene, refined.mesh, suspects, options.samples, mean, sampler, samples);
    refined.errors = std::move(measured.errors);
    evaluations += measured.point_evaluations;
    std::vector<std::uint32_t> doubtful;
    for (const std::uint32_t t : suspects)
      if (refined.errors[t].max <= options.error && guess[t] > kDoubt * options.error) doubtful.push_back(t);
    measured = MeasureTriangles(scene, refined.mesh, doubtful, options.samples + 1, mean, sampler, samples);
    for (const std::uint32_t t : doubtful)
      if (measured.errors[t].max > refined.errors[t].max) refined.errors[t] = measured.errors[t];
    evaluations += measured.point_evaluations;
    seconds.interpolate += interpolating.Seconds();

    double above = 0;
    std::vector<Candidate> candidates = FindCandidates(refined, options.error);
    for (const Candidate& candidate : candidates) above += candidate.area_above;
    refined.share_above = area > 0 ? above / area : 0;
    refined.unmet.clear();
    std::vector<ElementId> divide;
    for (const Candidate& candidate : candidates) {
      const Element& element = refined.forest[candidate.leaf];
      if (element.area < 4 * options.min_area || element.level >= kMaxLevel) {
        refined.unmet.push_back(candidate.leaf);
      } else if (round < options.max_rounds && above > kShareAbove * area) {
        divide.push_back(candidate.leaf);
        above -= candidate.mended;
      }
    }
    if (divide.empty()) break;
    std::vector<PatchId> touched;
    for (const ElementId leaf : divide) {
      touched.push_back(refined.forest[leaf].patch);
      refined.forest.Subdivide(leaf);
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const PatchId patch : touched) refined.forest.Balance(patch);
  }
  std::sort(refined.unmet.begin(), refined.unmet.end());
  refined.report.seconds = seconds;
  refined.report.counts.point_evaluations = evaluations;
  refined.report.counts.interpolants = refined.mesh.irradiance.size();
  return refined;
}

}  // namespace penumbra
