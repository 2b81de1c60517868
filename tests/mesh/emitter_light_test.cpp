// The light of each emitter alone: it adds up to the whole, obeys the laws that the whole obeys, and dims it.

#include "mesh/refinement/emitter_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "solver/base/random.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/emitters.h"
#include "solver/scene/scene_parts.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/points/point_irradiance.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra {
namespace {

// Rounding of a sum of a few numbers.
constexpr double kSumRounding = 1e-13;

PipelineOptions ByEmitter(double error, const std::string& solver = "hierarchical") {
  PipelineOptions options;
  options.error = error;
  options.by_emitter = true;
  options.solver = solver;
  return options;
}

void SolveAndShow(Pipeline& pipeline) {
  pipeline.Solve({});
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
}

double Largest(const std::vector<Rgb>& values) {
  double largest = 0;
  for (const Rgb& value : values) largest = std::max(largest, value.abs().maxCoeff());
  return largest;
}

// The largest difference between the sum over the emitters and the whole, relative to the largest value.
double SumDifference(const Pipeline& pipeline) {
  const RadiositySolution& whole = pipeline.solution();
  std::vector<Rgb> element(whole.forest.size(), Rgb::Zero()), fragment(whole.fragments.size(), Rgb::Zero()),
      middle(pipeline.mesh().triangles.size(), Rgb::Zero());
  for (const EmitterLight& light : pipeline.emitters()) {
    for (std::size_t e = 0; e < element.size(); ++e) element[e] += light.element[e];
    for (std::size_t i = 0; i < fragment.size(); ++i) fragment[i] += light.fragment[i];
    for (std::size_t t = 0; t < middle.size(); ++t) middle[t] += light.interpolant[t].At(0.3, 0.3);
  }
  std::vector<Rgb> whole_middle, whole_element;
  for (std::size_t e = 0; e < element.size(); ++e) {
    whole_element.push_back(whole.irradiance[e]);
    element[e] -= whole.irradiance[e];
  }
  for (std::size_t i = 0; i < fragment.size(); ++i) fragment[i] -= whole.fragments[i].irradiance;
  for (std::size_t t = 0; t < middle.size(); ++t) {
    whole_middle.push_back(pipeline.mesh().irradiance[t].At(0.3, 0.3));
    middle[t] -= whole_middle.back();
  }
  return std::max({Largest(element) / Largest(whole_element), Largest(fragment) / Largest(whole_element),
                   Largest(middle) / Largest(whole_middle)});
}

// The 99th percentile of the relative differences of the interpolants of two pipelines over the same scene.
double ShownDifference(const Scene& scene, const Pipeline& dimmed, const Pipeline& anew) {
  std::vector<Rgb> shown, want;
  for (const SurfacePoint& p : SpreadPoints(scene, ReflectingAreas(scene), 2000, 7)) {
    shown.push_back(dimmed.Interpolated(p.patch, p.position).value());
    want.push_back(anew.Interpolated(p.patch, p.position).value());
  }
  return Quantile(RelativeErrors(shown, want), 0.99);
}

// A solution whose emitters have been dimmed, as the commands make it from a file.
struct Dimmed {
  Dimmed(const Pipeline& from, const std::vector<Dimming>& dims) : scene(from.scene()) {
    const std::vector<Rgb> of_patch = DimmingFactors(scene, dims);
    PipelineState state{from.visibility(), from.solution(),  MeshKind::kInterpolant,
                        from.mesh(),       PipelineReport(), {}};
    state.emitters.assign(from.emitters().begin(), from.emitters().end());
    std::vector<Rgb> factors;
    for (const EmitterLight& light : state.emitters)
      factors.push_back(of_patch[static_cast<std::size_t>(light.patches[0])]);
    ScaleEmittance(scene, of_patch);
    state.solution.forest = state.solution.forest.Of(scene);
    ScaleLights(factors, state.emitters, state.solution, state.mesh);
    pipeline = std::make_unique<Pipeline>(scene, from.options(), std::move(state));
  }
  Scene scene;
  std::unique_ptr<Pipeline> pipeline;
};

// The lights of all emitters add up to the whole, to rounding, with every solver.
TEST(EmitterLight, AddsUpToTheWhole) {
  for (const char* solver : {"hierarchical", "dense", "sampled"}) {
    const Scene scene = *LoadBuiltinScene("floating-cube", {});
    PipelineOptions options = ByEmitter(0.2, solver);
    options.dense.divisions = 2;
    Pipeline pipeline(scene, options);
    SolveAndShow(pipeline);
    ASSERT_EQ(pipeline.emitters().size(), 2U) << solver;
    const double difference = SumDifference(pipeline);
    std::printf("%s: the sum differs by %.2g\n", solver, difference);
    EXPECT_LE(difference, kSumRounding) << solver;
  }
}

// Energy: in a closed room, what one emitter sends out is what is absorbed of its light. The room is a
// furnace of six emitters, where the whole irradiance is E / (1 - rho) everywhere.
TEST(EmitterLight, EachConservesItsEnergy) {
  const Scene scene = *LoadBuiltinScene("furnace", {});
  const double error = 0.05;
  Pipeline pipeline(scene, ByEmitter(error));
  SolveAndShow(pipeline);
  ASSERT_EQ(pipeline.emitters().size(), 6U);
  const Material& material = scene.materials[0];
  double worst = 0, worst_of_whole = 0;
  for (const EmitterLight& light : pipeline.emitters()) {
    Rgb absorbed = Rgb::Zero(), emitted = Rgb::Zero();
    for (std::size_t p = 0; p < scene.patches.size(); ++p)
      absorbed += scene.patches[p].area * (1 - material.reflectance) * light.element[p];
    for (const PatchId p : light.patches)
      emitted += scene.patches[static_cast<std::size_t>(p)].area * material.emittance;
    worst = std::max(worst, ((absorbed - emitted).abs() / emitted).maxCoeff());
  }
  const Rgb want = material.emittance / (1 - material.reflectance);
  for (const Rgb& irradiance : pipeline.solution().irradiance)
    worst_of_whole = std::max(worst_of_whole, ((irradiance - want).abs() / want).maxCoeff());
  std::printf("energy of one emitter %.2g, whole irradiance %.2g\n", worst, worst_of_whole);
  // The mesh suits the whole light, which is even: that of one face varies, and its means err by what was
  // asked.
  EXPECT_LE(worst, error);
  EXPECT_LE(worst_of_whole, error / 5);
}

// Dimming agrees with solving the dimmed scene anew within the error asked for. With the brighter lamp off,
// the mesh, which was made for both, errs by more of what is left; each side may then err by what was asked.
TEST(EmitterLight, DimmingAgreesWithASolveOfTheDimmedScene) {
  constexpr double kError = 0.1;
  const auto compare = [&](const Pipeline& whole, const Dimming& dim, double bound) {
    const Dimmed dimmed(whole, {dim});
    PipelineOptions options = ByEmitter(kError);
    options.by_emitter = false;
    Pipeline anew(dimmed.scene, options);
    SolveAndShow(anew);
    const double difference = ShownDifference(dimmed.scene, *dimmed.pipeline, anew);
    std::printf("%s at %g: dimmed against solved anew %.3g\n", dim.name.c_str(), kError, difference);
    EXPECT_LE(difference, bound) << dim.name;
  };
  const Scene cornell = *LoadBuiltinScene("cornell", {}), office = *LoadBuiltinScene("office", {});
  Pipeline box(cornell, ByEmitter(kError)), room(office, ByEmitter(kError));
  SolveAndShow(box);
  SolveAndShow(room);
  compare(box, {"light", Rgb(0.5, 0.25, 2)}, kError);
  compare(room, {"bright_light", Rgb::Constant(0.2)}, kError);
  compare(room, {"bright_light", Rgb::Zero()}, 2 * kError);
}

// Factor 1 leaves every bit as it was, and factor 0 leaves nothing. Exact irradiance at points follows the
// emitters: those of both alone add up to the whole.
TEST(EmitterLight, OneAndZeroAreExact) {
  const Scene scene = *LoadBuiltinScene("floating-cube", {});
  Pipeline pipeline(scene, ByEmitter(0.2));
  SolveAndShow(pipeline);
  const Dimmed same(pipeline, {{"left_light", Rgb::Ones()}, {"right_light", Rgb::Ones()}}),
      left(pipeline, {{"right_light", Rgb::Zero()}}), right(pipeline, {{"left_light", Rgb::Zero()}}),
      dark(pipeline, {{"left_light", Rgb::Zero()}, {"right_light", Rgb::Zero()}});
  const std::span<const QuadraticInterpolant> a = pipeline.mesh().irradiance,
                                              b = same.pipeline->mesh().irradiance;
  for (std::size_t t = 0; t < a.size(); ++t)
    ASSERT_TRUE((a[t].At(0.2, 0.3) == b[t].At(0.2, 0.3)).all() && (a[t].f == b[t].f).all()) << t;
  for (std::size_t e = 0; e < pipeline.solution().radiosity.size(); ++e)
    ASSERT_TRUE((pipeline.solution().radiosity[e] == same.pipeline->solution().radiosity[e]).all()) << e;
  EXPECT_EQ(Largest(dark.pipeline->solution().radiosity), 0);
  EXPECT_EQ(Largest(dark.pipeline->solution().irradiance), 0);
  double worst = 0;
  for (const SurfacePoint& p : SpreadPoints(scene, ReflectingAreas(scene), 100, 3)) {
    ReceiverPoint at;
    at.position = p.position;
    at.normal = scene.patches[static_cast<std::size_t>(p.patch)].normal;
    const auto exact = [&](const Pipeline& of) { return of.irradiance().OnPatch(p.patch, at).irradiance; };
    EXPECT_TRUE((exact(*dark.pipeline) == 0).all());
    const Rgb whole = exact(pipeline);
    worst =
        std::max(worst, ((exact(*left.pipeline) + exact(*right.pipeline) - whole).abs() / whole).maxCoeff());
  }
  std::printf("exact irradiance: left and right differ from the whole by %.2g\n", worst);
  EXPECT_LE(worst, 1e-11);  // of sums over some hundred sources
}

// The dense system is linear to rounding: dimming is the solution of the dimmed system.
TEST(EmitterLight, DimsADenseSolutionToRounding) {
  const Scene scene = *LoadBuiltinScene("floating-cube", {});
  PipelineOptions options = ByEmitter(0.2, "dense");
  options.dense.divisions = 2;
  Pipeline whole(scene, options);
  SolveAndShow(whole);
  const Dimmed dimmed(whole, {{"left_light", Rgb(0.1, 2, 0)}});
  Pipeline anew(dimmed.scene, options);
  anew.Solve({});
  double worst = 0;
  const std::vector<Rgb>& want = anew.solution().radiosity;
  for (std::size_t e = 0; e < want.size(); ++e)
    worst = std::max(worst, (dimmed.pipeline->solution().radiosity[e] - want[e]).abs().maxCoeff());
  EXPECT_LE(worst, 1e-12 * Largest(want));
}

// What excludes the light of each emitter is told, and the whole light is there.
TEST(EmitterLight, IsNotKeptWhereLeavesAreCutByTheirLight) {
  const Scene scene = *LoadBuiltinScene("floating-cube", {});
  PipelineOptions options = ByEmitter(0.5);
  options.source_error = 0.2;
  Pipeline pipeline(scene, options);
  SolveAndShow(pipeline);
  EXPECT_TRUE(pipeline.emitters().empty());
  const std::vector<std::string>& unmet = pipeline.report().unmet;
  EXPECT_TRUE(std::any_of(unmet.begin(), unmet.end(),
                          [](const std::string& line) { return line.starts_with("emitters: "); }));
  EXPECT_GT(Largest(pipeline.solution().irradiance), 0);
}

}  // namespace
}  // namespace penumbra
