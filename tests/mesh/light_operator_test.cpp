// The kept operator: the light of other emittances and reflectances by products.

#include "mesh/refinement/light_operator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "mesh/refinement/covered_light.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/scene_parts.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

struct SolvedScene {
  SolvedScene(const char* name, double error) : scene(*LoadBuiltinScene(name, {})) { Solve(error); }
  SolvedScene(Scene other, double error) : scene(std::move(other)) { Solve(error); }

  void Solve(double error) {
    PipelineOptions options;
    options.error = error;
    const Stopwatch stopwatch;
    pipeline.emplace(scene, options);
    pipeline->Solve({});
    pipeline->RefineLight({});
    pipeline->BuildMesh(MeshKind::kInterpolant, {});
    seconds = stopwatch.Seconds();
  }

  Scene scene;
  std::optional<Pipeline> pipeline;
  double seconds = 0;
};

// The 99th percentile of the relative differences of the interpolants of two pipelines over the same patches.
double DifferenceOf(const Scene& scene, const Pipeline& got, const Pipeline& want) {
  std::vector<Rgb> shown, truth;
  for (const SurfacePoint& p : SpreadPoints(scene, ReflectingAreas(scene), 2000, 11)) {
    shown.push_back(got.Interpolated(p.patch, p.position).value());
    truth.push_back(want.Interpolated(p.patch, p.position).value());
  }
  return Quantile(RelativeErrors(shown, truth), 0.99);
}

// In a closed room of one material irradiance is E / (1 - rho) everywhere, whatever the material was when the
// operator was made.
TEST(LightOperator, FurnaceOfAnotherMaterial) {
  const double error = 0.02;
  SolvedScene furnace("furnace", error);
  ASSERT_TRUE(furnace.pipeline->KeepOperator({}));
  Scene other = furnace.scene;
  other.materials[0].emittance = Rgb(3, 1, 0.5);
  other.materials[0].reflectance = Rgb(0.25, 0.5, 0.75);
  const Pipeline lit(other, furnace.pipeline->options(), furnace.pipeline->LitBy(other).value());
  double worst = 0;
  const Rgb want(4, 2, 2);
  for (const QuadraticInterpolant& q : lit.mesh().irradiance)
    worst = std::max(worst, ((q.At(0.3, 0.3) - want).abs() / want).maxCoeff());
  for (const Rgb& irradiance : lit.solution().irradiance)
    worst = std::max(worst, ((irradiance - want).abs() / want).maxCoeff());
  std::printf("worst relative error %.2g\n", worst);
  EXPECT_LE(worst, error / 4);
}

// Lighting a solved office anew agrees with a solve of the changed scene within the error asked for, and
// takes a small part of its time. (The time is printed; a test that runs beside others cannot bound it.)
TEST(LightOperator, AgreesWithASolveOfTheChangedScene) {
  const double error = 0.1;
  SolvedScene office("office", error);
  ASSERT_TRUE(office.pipeline->KeepOperator({}));
  const auto expect_agreement = [&](const char* what, const Scene& other, const SolvedScene& anew) {
    const Stopwatch stopwatch;
    std::optional<PipelineState> state = office.pipeline->LitBy(other);
    const double seconds = stopwatch.Seconds();
    ASSERT_TRUE(state.has_value());
    const Pipeline lit(other, office.pipeline->options(), std::move(*state));
    const double difference = DifferenceOf(other, lit, *anew.pipeline);
    std::printf("%s: differs by %.3g; %.4f s for %.3f s of a solve: 1/%.0f; %.3g MB\n", what, difference,
                seconds, anew.seconds, anew.seconds / seconds,
                1e-6 * static_cast<double>(office.pipeline->OperatorBytes()));
    EXPECT_LE(difference, error) << what;
  };
  expect_agreement("the same", office.scene, office);
  Scene changed = office.scene;
  for (Material& material : changed.materials) {
    if (material.name == "floor") material.reflectance = Rgb(0.1, 0.2, 0.6);
    if (material.name == "bright_light") material.emittance *= 0.3;
  }
  const SolvedScene anew(changed, error);
  expect_agreement("a blue floor and a dimmed lamp", changed, anew);
}

// A patch that was black and dark has no place in the operator: what sends light now is told.
TEST(LightOperator, RefusesNewSources) {
  Scene scene = *LoadBuiltinScene("floating-cube", {});
  const auto cube = std::find_if(scene.materials.begin(), scene.materials.end(),
                                 [](const Material& material) { return material.name == "cube"; });
  cube->reflectance = Rgb::Zero();
  SolvedScene solved(scene, 0.5);
  EXPECT_FALSE(solved.pipeline->LitBy(solved.scene).has_value());  // nothing is kept yet
  ASSERT_TRUE(solved.pipeline->KeepOperator({}));
  EXPECT_TRUE(solved.pipeline->LitBy(solved.scene).has_value());
  Scene other = solved.scene;
  other.materials[static_cast<std::size_t>(cube - scene.materials.begin())].emittance = Rgb::Ones();
  EXPECT_FALSE(solved.pipeline->LitBy(other).has_value());
}

// The weights of samples give the mean of any quadratic over a part of a mesh.
TEST(LightOperator, WeightsOfSamplesGiveTheMean) {
  IrradianceMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  mesh.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
  std::vector<std::array<Rgb, 6>> samples;
  for (int t = 0; t < 2; ++t) {
    std::array<Rgb, 6>& six = samples.emplace_back();
    for (int k = 0; k < 6; ++k) six[static_cast<std::size_t>(k)] = Rgb(k * k + t, 3 - k, 0.5 * k * t);
    mesh.irradiance.push_back(QuadraticInterpolant::Quadratic(six));
  }
  const Frame frame = MakeFrame(Vec3::Zero(), Vec3::UnitZ());
  const CoveredLight all(mesh, 0, 2, frame);
  const Polygon2 polygon = {frame.ToPlane(Vec3(0.3, 0.1, 0)), frame.ToPlane(Vec3(1.7, 0.4, 0)),
                            frame.ToPlane(Vec3(1.1, 1.9, 0)), frame.ToPlane(Vec3(0.4, 1.6, 0))};
  for (const CoveredLight& part : {all, all.Within(polygon)}) {
    Rgb mean = Rgb::Zero();
    double total = 0;
    for (const CoveredLight::SampleWeights& weights : part.MeanWeights())
      for (std::size_t k = 0; k < 6; ++k) {
        mean += weights.weight[k] * samples[weights.triangle][k];
        total += weights.weight[k];
      }
    EXPECT_LE((mean - part.Mean()).abs().maxCoeff(), 1e-14);
    EXPECT_NEAR(total, 1, 1e-15);
  }
}

}  // namespace
}  // namespace penumbra
