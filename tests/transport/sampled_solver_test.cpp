// The sampled solver, final gathering and shadow rays, against closed forms and exact irradiance.

#include "solver/transport/solvers/sampled_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/geometry/polygon.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/links/element_locator.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/final_gather.h"
#include "solver/transport/points/mean_free_path.h"
#include "solver/transport/points/neighbour_groups.h"
#include "solver/transport/points/ray_ends.h"
#include "solver/transport/points/shadow_rays.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra {
namespace {

// A closed box in which every surface emits `emittance` and reflects the rest of a unit of radiosity, so that
// irradiance and radiosity are 1 everywhere (a furnace), with a smaller box in the middle of its floor.
Scene Furnace(double reflectance) {
  Scene scene;
  scene_test::AddMaterial(scene, reflectance, 1 - reflectance);
  scene_test::AddBox(scene, Vec3::Zero(), {2, 3, 2.5}, true, 0);
  scene_test::AddBox(scene, {0.5, 0.9, 0.4}, {1.3, 1.7, 1.2}, false, 0);
  return scene;
}

// Fewer elements than by default, to save time.
SampledOptions Coarse() {
  SampledOptions options;
  options.elements = 2000;
  return options;
}

RadiositySolution Sampled(const Scene& scene, const SampledOptions& options = Coarse()) {
  SampledSolver solver(scene, options);
  EXPECT_TRUE(SolveStepByStep(solver, {}));
  EXPECT_TRUE(solver.Converged());
  return solver.solution();
}

ReceiverPoint At(const Scene& scene, const SurfacePoint& point) {
  const Vec3& normal = scene.patches[static_cast<std::size_t>(point.patch)].normal;
  return scene_test::Receiver(point.position, normal, normal);
}

// Rows of a closed room add up to 1. What is left is the error of direct light from walls that rays find
// partly hidden: about 0.5 %, which reflectance 0.9 multiplies by up to 10 in the light of all bounces.
TEST(SampledSolver, KeepsAFurnaceAtOne) {
  constexpr double kTolerance = 0.05;
  double worst = 0, mean = 0, area = 0;
  for (const double reflectance : {0.2, 0.5, 0.9}) {
    const Scene scene = Furnace(reflectance);
    const RadiositySolution solution = Sampled(scene);
    for (const ElementId leaf : solution.forest.AllLeaves()) {
      mean += solution.forest[leaf].area * solution.irradiance[leaf].mean();
      area += solution.forest[leaf].area;
    }
    const FinalGather gather(solution, {});
    for (const SurfacePoint& point : SpreadPoints(scene, 100, 3))
      worst = std::max(worst, (gather.At(At(scene, point)) - 1).abs().maxCoeff());
  }
  std::printf("largest deviation from 1: %.2g at points, %.2g on average\n", worst,
              std::abs(mean / area - 1));
  EXPECT_LT(worst, kTolerance);
  EXPECT_LT(std::abs(mean / area - 1), kTolerance / 4);
}

// Sampled and exact irradiance are of the same light.
TEST(SampledSolver, AgreesWithTheHierarchicalSolver) {
  constexpr double kMedian = 0.01, kTail = 0.08;
  const Scene scene = *LoadBuiltinScene("cornell", {});
  const PatchVisibility visibility(scene);
  const RadiositySolution exact = scene_test::Solved(scene, 0.05, 1e-3);
  const PointIrradiance reference(exact, visibility);
  SampledOptions options = Coarse();
  options.point_rays = 1024;
  const RadiositySolution sampled = Sampled(scene, options);
  const PatchVisibility none = PatchVisibility::WithoutPairs(scene);
  const PointIrradiance points(sampled, none);
  std::vector<double> errors;
  for (const SurfacePoint& point : SpreadPoints(scene, 200, 5)) {
    const Rgb want = reference.OnPatch(point.patch, At(scene, point)).irradiance;
    const Rgb got = points.OnPatch(point.patch, At(scene, point)).irradiance;
    if (want.maxCoeff() > 0.05) errors.push_back(((got - want) / want.maxCoeff()).abs().maxCoeff());
  }
  std::sort(errors.begin(), errors.end());
  const double median = errors[errors.size() / 2], tail = errors[errors.size() * 95 / 100];
  std::printf("relative difference of %zu points: median %.2g, 95th percentile %.2g\n", errors.size(), median,
              tail);
  EXPECT_LT(median, kMedian);
  EXPECT_LT(tail, kTail);
}

// A ray at an element's own light and one that gathers that light anew bring the same on average.
TEST(FinalGather, GathersAnewWhatElementsHold) {
  const Scene scene = *LoadBuiltinScene("cornell", {});
  const RadiositySolution solution = Sampled(scene);
  FinalGatherOptions anew;
  anew.regather = true;
  anew.seed = 4;
  const FinalGather gather(solution, {}), again = gather.With(anew);
  Rgb sum = Rgb::Zero(), sum_again = Rgb::Zero();
  for (const SurfacePoint& point : SpreadPoints(scene, 100, 9)) {
    sum += gather.At(At(scene, point));
    sum_again += again.At(At(scene, point));
  }
  const double difference = ((sum - sum_again) / sum).abs().maxCoeff();
  std::printf("difference of the mean: %.2g\n", difference);
  EXPECT_LT(difference, 0.02);
}

// Shadow rays that are allowed to cut by blockers give exact direct light where they find a luminaire half
// hidden.
TEST(ShadowRays, AgreeWithExactDirectLight) {
  const Scene scene = *LoadBuiltinScene("office", {});
  const RayCaster caster(scene);
  const ShadowRays rays(scene, caster);
  const ShadowRayEffort fine = {.divisions = 8, .closer_above = 0.001, .seed = 0};
  double worst = 0, sum = 0;
  for (const SurfacePoint& point : SpreadPoints(scene, 300, 2)) {
    const ReceiverPoint at = At(scene, point);
    const Rgb want = scene_test::Direct(scene, at).irradiance;
    const double off = (rays.At(at, fine) - want).abs().maxCoeff();
    worst = std::max(worst, off);
    sum += want.maxCoeff();
  }
  std::printf("largest deviation: %.2g of the mean direct light\n", worst * 300 / sum);
  EXPECT_LT(worst, 0.05 * sum / 300);
}

// Points whose rays are traced together get the light that they get alone, but for the choice of the weak
// luminaires.
TEST(ShadowRays, GiveGroupsTheLightOfEachPoint) {
  const Scene scene = *LoadBuiltinScene("office", {});
  const RayCaster caster(scene);
  const ShadowRays rays(scene, caster);
  double worst = 0, sum = 0;
  for (const int if_hidden : {0, 64}) {
    const ShadowRayEffort effort{
        .divisions = 4, .closer_above = 0.02, .rays_if_hidden = if_hidden, .seed = 0};
    for (const SurfacePoint& point : SpreadPoints(scene, 100, 6)) {
      std::array<ReceiverPoint, ShadowRays::kTogether> group;
      group.fill(At(scene, point));
      const Frame frame = MakeFrame(Vec3::Zero(), group[0].normal);
      for (std::size_t k = 1; k < group.size(); ++k)
        group[k].position += 0.02 * static_cast<double>(k) * (k % 2 == 0 ? frame.u : frame.v);
      std::array<Rgb, ShadowRays::kTogether> together;
      rays.AtAll(group, effort, together);
      for (std::size_t k = 0; k < group.size(); ++k) {
        const Rgb alone = rays.At(group[k], effort);
        worst = std::max(worst, (together[k] - alone).abs().maxCoeff());
        sum += alone.maxCoeff() / 1600;
      }
    }
  }
  std::printf("largest difference: %.2g of the mean direct light\n", worst / sum);
  EXPECT_LT(worst, 0.05 * sum);
}

// The digits of a file leave a face planar to rounding only, so that a point on it may lie behind a part of
// it. The point gets the light of the point a hundredth of a millimetre before the face.
TEST(ShadowRays, LightPointsOnFacesThatAreRounded) {
  constexpr double kOffPlane = 1e-8;  // far below the 1e-6 of its diameter that a face may be off its plane
  Scene scene;
  const std::int32_t grey = scene_test::AddMaterial(scene, 0.5, 0),
                     lamp = scene_test::AddMaterial(scene, 0, 3);
  scene_test::Add(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, kOffPlane}, {0, 1, 0}}, grey);
  scene_test::Add(scene, {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, lamp);
  scene_test::Add(scene, {{0.2, 0.3, 0.5}, {0.2, 0.6, 0.5}, {0.5, 0.6, 0.5}, {0.5, 0.3, 0.5}}, grey);
  const RayCaster caster(scene);
  const ShadowRays rays(scene, caster);
  double worst = 0;
  for (const SurfacePoint& point : SpreadPoints(scene, std::vector<double>{1, 0, 0}, 50, 3)) {
    ReceiverPoint at = At(scene, point), above = at;
    at.position.z() -= kOffPlane;
    above.position.z() += 1e-5;
    const double want = rays.At(above, {}).maxCoeff();
    worst = std::max(worst, std::abs(rays.At(at, {}).maxCoeff() - want) / want);
  }
  std::printf("largest relative difference: %.2g\n", worst);
  EXPECT_LT(worst, 1e-3);
}

// A reflector lights the points before it and not those in its plane, also if their rays are traced together.
TEST(ShadowRays, LeaveOutPointsInThePlaneOfAReflector) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 0);
  scene_test::AddBox(scene, Vec3::Zero(), {2, 2, 2}, true, 0);
  const RayCaster caster(scene);
  // On the floor, beside the middle of the wall x = 0.
  constexpr PatchId kWall = 4;
  const BrightReflector wall{kWall, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, Rgb::Ones()};
  const std::array<BrightReflector, 1> reflectors = {wall};
  ASSERT_EQ(scene.patches[kWall].normal, Vec3::UnitX());
  const ShadowRays rays(scene, caster, reflectors);
  std::array<ReceiverPoint, 3> group;
  for (std::size_t k = 0; k < group.size(); ++k)
    group[k] = scene_test::Receiver({0.1 * static_cast<double>(k), 0.5, 0}, Vec3::UnitZ());
  std::array<Rgb, 3> light;
  rays.AtAll(group, {}, light);
  EXPECT_EQ(light[0].maxCoeff(), 0);
  EXPECT_GT(light[1].minCoeff(), light[2].maxCoeff());
}

// Behind the slats of a fence, the only lamp gets enough rays: their error is that of the whole light.
TEST(ShadowRays, FollowEnoughRaysToTheOnlyLamp) {
  Scene scene;
  const std::int32_t grey = scene_test::AddMaterial(scene, 0.5, 0),
                     lamp = scene_test::AddMaterial(scene, 0, 10);
  scene_test::Add(scene, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, grey);
  scene_test::Add(scene, {{-2, -1, 3}, {-2, 1, 3}, {2, 1, 3}, {2, -1, 3}}, lamp);
  for (int k = -12; k <= 12; ++k)
    scene_test::AddBox(scene, {0.1 * k - 0.03, -2, 1}, {0.1 * k + 0.03, 2, 1.02}, false, grey);
  const RayCaster caster(scene);
  const ShadowRays rays(scene, caster);
  const ShadowRayEffort by_rays{.divisions = 4, .closer_above = 0.02, .rays_if_hidden = 48, .seed = 0};
  const ShadowRayEffort exact{.divisions = 4, .closer_above = 0.001, .rays_if_hidden = 0, .seed = 0};
  std::vector<double> errors;
  const std::vector<double> floor_only = {1};
  for (const SurfacePoint& point : SpreadPoints(scene, std::array<PatchId, 1>{0}, floor_only, 100, 12)) {
    const double want = rays.At(At(scene, point), exact).maxCoeff();
    errors.push_back(std::abs(rays.At(At(scene, point), by_rays).maxCoeff() / want - 1));
  }
  std::sort(errors.begin(), errors.end());
  std::printf("relative error behind slats: median %.2g, 95th percentile %.2g\n", errors[50], errors[95]);
  EXPECT_LT(errors[95], 0.1);
}

// In a building, most lamps are behind walls. Points that have learnt so send these lamps few rays, but lose
// no light, not even through doorways.
TEST(ShadowRays, KeepTheLightOfLampsThatSeemHidden) {
  const Scene scene = *LoadBuiltinScene("building-4x4", {});
  const RayCaster caster(scene);
  const ShadowRays all(scene, caster);
  ShadowRays learnt(scene, caster);
  std::vector<ReceiverPoint> lookers;
  for (const SurfacePoint& point : SpreadPoints(scene, 20'000, 4)) lookers.push_back(At(scene, point));
  learnt.Learn(lookers, 1.5);
  Rgb sum = Rgb::Zero(), sum_learnt = Rgb::Zero();
  double squares = 0, squares_learnt = 0;
  std::uint64_t seed = 0;
  for (const SurfacePoint& point : SpreadPoints(scene, 3000, 8)) {
    ShadowRayEffort effort{.divisions = 4, .rays_if_hidden = 64, .seed = ++seed};
    const ReceiverPoint at = At(scene, point);
    const Rgb light = all.At(at, effort), light_learnt = learnt.At(at, effort);
    effort.divisions = 12;
    effort.seed += 10'000;
    const Rgb truth = all.At(at, effort);
    sum += light;
    sum_learnt += light_learnt;
    squares += (light - truth).square().sum();
    squares_learnt += (light_learnt - truth).square().sum();
  }
  const double difference = ((sum_learnt - sum) / sum).abs().maxCoeff();
  std::printf("difference of the mean %.2g; deviation of a point %.3g of the mean, %.3g with learning\n",
              difference, std::sqrt(squares / 9000) / (sum.mean() / 3000),
              std::sqrt(squares_learnt / 9000) / (sum.mean() / 3000));
  EXPECT_LT(difference, 0.002);
  EXPECT_LT(squares_learnt, 2 * squares);
}

// A bright reflector counts as a luminaire: the same light as that of an emitter in its place.
TEST(ShadowRays, TakeReflectorsForEmitters) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 0);
  scene_test::AddMaterial(scene, 0, 3);
  const Polygon3 lamp = {{0, 0, 1}, {0, 0.3, 1}, {0.3, 0.3, 1}, {0.3, 0, 1}};
  scene_test::Add(scene, {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, 0);
  scene_test::Add(scene, lamp, 1);
  Scene grey = scene;
  grey.materials[1].emittance = Rgb::Zero();
  const RayCaster caster(scene);
  const ShadowRays emitters(scene, caster);
  const std::vector<BrightReflector> reflectors = {{1, lamp, Rgb::Constant(3)}};
  const ShadowRays others(grey, caster, reflectors);
  for (const Vec3& place : {Vec3(0.1, 0.1, 0), Vec3(1.5, -0.7, 0), Vec3(-1.9, 1.9, 0)}) {
    const ReceiverPoint at = scene_test::Receiver(place, Vec3::UnitZ(), Vec3::UnitZ());
    const double want = emitters.At(at, {}).x();
    EXPECT_GT(want, 0);
    EXPECT_NEAR(others.At(at, {}).x(), want, 0.01 * want);
  }
}

// The table finds the leaves that descending through the quadtree finds.
TEST(ElementLocator, FindsTheLeavesOfTheForest) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 0);
  scene_test::Add(scene, {{0, 0, 0}, {2, 0.3, 0}, {2.5, 1.9, 0}, {-0.2, 1.1, 0}}, 0);
  scene_test::Add(scene, {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1}}, 0);
  scene_test::Add(scene, {{0, 0, 2}, {2, 0.5, 2.4}, {0.3, 1.5, 2.2}}, 0);
  ElementForest forest(scene);
  Random random(5);
  for (int k = 0; k < 60; ++k) {
    const auto element = static_cast<ElementId>(random.Index(static_cast<std::uint32_t>(forest.size())));
    if (forest[element].IsLeaf() && forest[element].level < 8) forest.Subdivide(element);
  }
  const ElementLocator locator(forest);
  for (int k = 0; k < 3000; ++k) {
    const auto p = static_cast<PatchId>(random.Index(3));
    const Vec3 point =
        PointOn(scene.patches[static_cast<std::size_t>(p)].Vertices(), random.Uniform(), random.Uniform());
    const ElementLocator::Place place = locator.Find(p, point);
    EXPECT_EQ(place.element, forest.LeafAt(p, point));
    EXPECT_EQ(locator.LeafAt(p, point), place.element);
    const Element& leaf = forest[place.element];
    const double s = place.s, t = place.t;
    const Vec3 back = leaf.size == 3
                          ? Vec3((1 - s - t) * leaf.vertex[0] + s * leaf.vertex[1] + t * leaf.vertex[2])
                          : Vec3((1 - t) * ((1 - s) * leaf.vertex[0] + s * leaf.vertex[1]) +
                                 t * ((1 - s) * leaf.vertex[3] + s * leaf.vertex[2]));
    EXPECT_LT((back - point).norm(), 1e-9);
  }
}

// A point is one-sided exactly where something stands on its surface.
TEST(FinalGather, KnowsWhatStandsOnASurface) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 1);
  scene_test::Add(scene, {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, 0);
  scene_test::Add(scene, {{-1, 0, 0}, {1, 0, 0}, {1, 0, 1}, {-1, 0, 1}}, 0);
  const FinalGather gather(Sampled(scene), {});
  const std::array<ReceiverPoint, 3> at = {scene_test::Receiver({0.3, 0, 0}, Vec3::UnitZ()),
                                           scene_test::Receiver({0.3, 0.01, 0}, Vec3::UnitZ()),
                                           scene_test::Receiver({1.5, 0, 0}, Vec3::UnitZ())};
  EXPECT_EQ(gather.AreOneSided(at), 1U);
  for (std::size_t k = 0; k < at.size(); ++k)
    EXPECT_EQ(gather.AreOneSided(std::span(at).subspan(k, 1)), k == 0 ? 1U : 0U);
}

// The floor of two rooms is one patch. What the bright room reflects does not leak under the wall between.
TEST(FinalGather, KeepsLightBehindAWall) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 0);
  scene_test::AddMaterial(scene, 0, 10);
  scene_test::AddMaterial(scene, 0, 1);
  scene_test::AddBox(scene, Vec3::Zero(), {4, 2, 2}, true, 0);
  scene_test::AddBox(scene, {2.03, 0, 0}, {2.08, 2, 2}, false, 0);
  scene_test::AddBox(scene, {0.5, 0.5, 1.9}, {1.5, 1.5, 1.95}, false, 1);
  scene_test::AddBox(scene, {2.5, 0.5, 1.9}, {3.5, 1.5, 1.95}, false, 2);
  const PatchVisibility visibility(scene);
  const RadiositySolution exact = scene_test::Solved(scene, 0.1, 1e-3);
  const PointIrradiance reference(exact, visibility);
  SampledOptions options = Coarse();
  options.elements = 500;
  options.passes = 1;
  const FinalGather gather(Sampled(scene, options), {});
  double worst = 0;
  for (int k = 0; k < 8; ++k) {
    // On the dark side of the wall, close to the floor.
    const ReceiverPoint at = scene_test::Receiver({2.08, 0.3 + 0.2 * k, 0.05}, Vec3::UnitX(), Vec3::UnitX());
    const double want = reference.Anywhere(at).irradiance[0];
    worst = std::max(worst, std::abs(gather.At(at)[0] / want - 1));
  }
  std::printf("largest relative difference behind the wall: %.2g\n", worst);
  EXPECT_LT(worst, 0.15);
}

// A box about `centre`, turned, with its fronts outwards.
void AddTurnedBox(Scene& scene, const Vec3& centre, const Vec3& half, const Eigen::AngleAxisd& turn,
                  std::int32_t material) {
  const std::size_t first = scene.patches.size();
  scene_test::AddBox(scene, -half, half, false, material);
  for (std::size_t p = first; p < scene.patches.size(); ++p) {
    for (Vec3& v : scene.patches[p].vertex) v = centre + turn * v;
    scene.patches[p].normal = turn * scene.patches[p].normal;
  }
}

// No light enters a sealed box that crosses the floor, though elements of the floor lie on both sides of its
// walls: what stands inside stays dark.
TEST(SampledSolver, LeavesSealedBoxesDark) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.8, 0);
  scene_test::AddMaterial(scene, 0, 10);
  scene_test::AddBox(scene, Vec3::Zero(), {4, 3, 2.5}, true, 0);
  scene_test::Add(scene, {{1, 1, 2.4}, {1, 2, 2.4}, {3, 2, 2.4}, {3, 1, 2.4}}, 1);
  const Vec3 centre(2.03, 1.41, 0.1), half(0.5, 0.4, 0.6);
  const Eigen::AngleAxisd turn(0.7, Vec3(0.2, -0.3, 1).normalized());
  AddTurnedBox(scene, centre, half, turn, 0);
  const auto first_inside = static_cast<PatchId>(scene.patches.size());
  AddTurnedBox(scene, {2.0, 1.4, 0.05}, {0.1, 0.15, 0.2}, turn, 0);
  const RadiositySolution solution = Sampled(scene);
  double mean = 0, area = 0, worst = 0;
  for (const ElementId leaf : solution.forest.AllLeaves()) {
    mean += solution.forest[leaf].area * solution.irradiance[leaf].mean();
    area += solution.forest[leaf].area;
  }
  mean /= area;
  std::size_t fragments = 0;
  for (const Fragment& fragment : solution.fragments) {
    Vec3 inside = turn.inverse() * (Centroid(fragment.polygon) - centre);
    if (solution.forest[fragment.leaf].patch != 0 || (inside.cwiseAbs() - half).maxCoeff() > 0) continue;
    worst = std::max(worst, fragment.irradiance.maxCoeff());
    ++fragments;
  }
  EXPECT_GT(fragments, 10U);
  const FinalGather gather(solution, {});
  for (const SurfacePoint& point : SpreadPoints(scene, 3000, 3))
    if (point.patch >= first_inside) worst = std::max(worst, gather.At(At(scene, point)).maxCoeff());
  std::printf("largest light of %zu fragments and at points inside: %.2g of the mean\n", fragments,
              worst / mean);
  EXPECT_LT(worst, 1e-3 * mean);
}

// The bytes of the light do not depend on the number of threads, nor on whether the light was computed
// before.
TEST(SampledSolver, GivesTheSameBytes) {
  const Scene scene = *LoadBuiltinScene("office", {});
  std::vector<RadiositySolution> solutions;
  for (const int threads : {1, 2, 7}) {
    SetThreadCount(threads);
    solutions.push_back(Sampled(scene));
  }
  SetThreadCount(0);
  for (const RadiositySolution& other : solutions) {
    ASSERT_EQ(other.forest.size(), solutions[0].forest.size());
    for (std::size_t e = 0; e < other.irradiance.size(); ++e)
      ASSERT_TRUE((other.irradiance[e] == solutions[0].irradiance[e]).all());
  }
}

// New emittances over the kept matrix give the light of a new solver: light is linear.
TEST(SampledSolver, RelightsOverItsMatrix) {
  Scene scene = *LoadBuiltinScene("cornell", {});
  SampledSolver solver(scene, Coarse());
  ASSERT_TRUE(SolveStepByStep(solver, {}));
  const RadiositySolution before = solver.solution();
  for (Material& material : scene.materials) material.emittance *= 2;
  ASSERT_TRUE(solver.Relight({}));
  ASSERT_EQ(solver.solution().forest.size(), before.forest.size());
  double worst = 0;
  for (std::size_t e = 0; e < before.irradiance.size(); ++e)
    worst = std::max(worst, (solver.solution().irradiance[e] - 2 * before.irradiance[e]).abs().maxCoeff() /
                                (1e-3 + before.irradiance[e].maxCoeff()));
  std::printf("largest relative deviation from twice the light: %.2g\n", worst);
  EXPECT_LT(worst, 0.01);
}

// A pass that is cancelled leaves the light and the elements as they were.
TEST(SampledSolver, KeepsTheLightOfTheLastPass) {
  const Scene scene = *LoadBuiltinScene("cornell", {});
  SampledSolver solver(scene, Coarse());
  ASSERT_TRUE(solver.Step(SolverStep::kIterate, {}));
  const RadiositySolution before = solver.solution();
  ExecutionContext cancelled;
  cancelled.Cancel();
  EXPECT_FALSE(solver.Step(SolverStep::kIterate, cancelled));
  ASSERT_EQ(solver.solution().forest.size(), before.forest.size());
  for (std::size_t e = 0; e < before.irradiance.size(); ++e)
    EXPECT_TRUE((solver.solution().irradiance[e] == before.irradiance[e]).all());
  EXPECT_TRUE(solver.Step(SolverStep::kIterate, {}));
  EXPECT_TRUE(solver.Converged());
}

TEST(MeanFreePath, IsFourVolumesPerAreaInAClosedRoom) {
  for (const Vec3& size : {Vec3(1, 1, 1), Vec3(4, 5, 3), Vec3(1, 8, 2)}) {
    Scene scene;
    scene_test::AddMaterial(scene, 0.5, 0);
    scene_test::AddBox(scene, Vec3::Zero(), size, true, 0);
    const double area = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
    const double want = 4 * size.prod() / area, got = MeanFreePath(scene);
    std::printf("mean free path %.4g, wanted %.4g\n", got, want);
    EXPECT_NEAR(got, want, 0.03 * want);
  }
}

TEST(NeighbourGroups, HaveEachPointOnceAndEqualNormals) {
  Random random(17);
  std::vector<ReceiverPoint> points;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 normal = Vec3::Unit(static_cast<int>(random.Index(3))) * (random.Index(2) == 0 ? 1 : -1);
    points.push_back(scene_test::Receiver(
        {random.Uniform(-5, 5), random.Uniform(0, 1e-3), i % 10 == 0 ? 0 : random.Uniform(0, 2)}, normal));
  }
  std::vector<int> times(points.size(), 0);
  const std::vector<std::vector<std::size_t>> groups = GroupNeighbours(points, 8);
  for (const std::vector<std::size_t>& group : groups) {
    ASSERT_LE(group.size(), 8U);
    for (const std::size_t i : group) {
      ++times[i];
      EXPECT_EQ(points[i].normal, points[group[0]].normal);
    }
  }
  for (const int count : times) EXPECT_EQ(count, 1);
  EXPECT_LE(groups.size(), points.size() / 8 + 6);  // only the last group of a normal is incomplete
  EXPECT_TRUE(GroupNeighbours({}, 8).empty());
}

}  // namespace
}  // namespace penumbra
