// What irradiance at a point is made of, and how sources and blockers are found.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/transport/points/gathering.h"
#include "tests/cases.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

// A furnished room, every patch of which sends some light, in the colours of its own.
Scene BrightRoom(Random& random, int boxes) {
  Scene scene = FurnishedRoom(random, boxes);
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    Material material;
    material.emittance = Rgb(random.Uniform(0.1, 1), random.Uniform(0.1, 1), random.Uniform(0.1, 1));
    scene.patches[p].material = static_cast<std::int32_t>(scene.materials.size());
    scene.materials.push_back(material);
  }
  return scene;
}

// Off the grid of the furniture, where nothing is singular.
Vec3 PointInRoom(Random& random) {
  const auto off_grid = [&] { return 0.25 * random.Index(16) + random.Uniform(0.03, 0.22); };
  const double x = off_grid(), y = off_grid();
  return {x, y, off_grid()};
}

// Brute force: every patch is asked about with all patches as candidates.
Rgb WithoutHierarchy(const Scene& scene, const SourceSet& sources, const ReceiverPoint& at) {
  std::vector<PatchId> all(scene.patches.size());
  std::iota(all.begin(), all.end(), 0);
  Gathering gathering(scene, sources, at, {}, nullptr);
  for (const PatchId source : all) gathering.AddSource(source, all, kNoPatch);
  return gathering.irradiance();
}

// The hierarchies find all that matters, and screens hide nothing that is seen. What is in a shadow on the
// whole must not differ in a bit; pieces may be cut in another order: 1e-14 of what the room sends.
TEST(PointIrradiance, HierarchyMissesNothing) {
  Random random(801);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const Motion motion = RandomMotion(random, i % 2 == 0 ? 0 : 3);
    const Scene scene = Mapped(BrightRoom(random, 1 + static_cast<int>(random.Index(8))), motion);
    const SourceSet sources = SourceSet::Emitters(scene);
    const PatchVisibility unused;
    const PointIrradiance irradiance(scene, unused, sources);
    for (int k = 0; k < 5; ++k) {
      const ReceiverPoint at = Receiver(motion(PointInRoom(random)), RandomDirection(random));
      const Rgb got = irradiance.Anywhere(at).irradiance, want = WithoutHierarchy(scene, sources, at);
      worst = std::max(worst, (got - want).abs().maxCoeff());
    }
  }
  std::printf("seed 801, largest difference %.2g\n", worst);
  EXPECT_LE(worst, 1e-14);
}

// Contributions add up to the whole, each patch once; direct light is what emitters alone give.
TEST(PointIrradiance, PartsAddUp) {
  Random random(802);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const Scene scene = BrightRoom(random, 4);
    const PatchVisibility unused;
    const PointIrradiance irradiance(scene, unused, SourceSet::Emitters(scene));
    const ReceiverPoint at = Receiver(PointInRoom(random), RandomDirection(random));
    IrradianceParts parts;
    const Rgb whole = irradiance.Anywhere(at, &parts).irradiance;
    Rgb sum = Rgb::Zero();
    PatchId last = kNoPatch;
    for (const PatchContribution& part : parts.contributions) {
      EXPECT_GT(part.source, last);
      last = part.source;
      sum += part.irradiance;
    }
    EXPECT_TRUE((whole == irradiance.Anywhere(at).irradiance).all()) << "asking for parts changed the whole";
    worst = std::max({worst, (sum - whole).abs().maxCoeff(), (parts.direct - whole).abs().maxCoeff()});
  }
  std::printf("seed 802, largest difference %.2g\n", worst);
  EXPECT_LE(worst, 1e-14);
}

// Of a solution the direct light is what the emitters send, and the rest has been reflected.
TEST(PointIrradiance, DirectLightOfASolution) {
  Random random(803);
  const Scene scene = FurnishedRoom(random, 3);
  const PatchVisibility visibility(scene);
  const RadiositySolution solution = Solved(scene, 1);
  const PointIrradiance whole(solution, visibility);
  for (int k = 0; k < 50; ++k) {
    const ReceiverPoint at = Receiver(PointInRoom(random), RandomDirection(random));
    IrradianceParts parts;
    const Rgb all = whole.Anywhere(at, &parts).irradiance, direct = Direct(scene, at).irradiance;
    EXPECT_NEAR(parts.direct[0], direct[0], 1e-13);
    EXPECT_GE(all[0], direct[0] - 1e-13);
  }
}

// The gradient is what differences tend to, in every direction, past blockers too. Central differences over
// 2 h err by h^2 times a third derivative, some 1 / distance^3 with edges no nearer than 0.03 m, and by 1e-15
// over h. Where an edge of a shadow meets a vertex within h the gradient itself jumps: such points are
// counted, not compared.
void ExpectGradient(const Scene& scene, const Motion& motion, Random& random, double& worst, int& kinks) {
  const PatchVisibility unused;
  const PointIrradiance irradiance(scene, unused, SourceSet::Emitters(scene));
  const ReceiverPoint at = Receiver(motion(PointInRoom(random)), RandomDirection(random));
  IrradianceParts parts;
  const Rgb here = irradiance.Anywhere(at, &parts).irradiance;
  constexpr double kStep = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const auto moved = [&](double step) {
      ReceiverPoint there = at;
      there.position[axis] += step;
      return irradiance.Anywhere(there).irradiance;
    };
    const Rgb ahead = moved(kStep), back = moved(-kStep);
    for (int channel = 0; channel < 3; ++channel) {
      const double difference = (ahead[channel] - back[channel]) / (2 * kStep);
      const double bend = (ahead[channel] - 2 * here[channel] + back[channel]) / kStep;
      const double error = std::abs(parts.gradient(channel, axis) - difference);
      if (std::abs(bend) > 1e-2) {
        ++kinks;
        continue;
      }
      EXPECT_LE(error, 1e-4 + std::abs(bend)) << "axis " << axis << " channel " << channel;
      worst = std::max(worst, error);
    }
  }
}

TEST(PointIrradiance, GradientMatchesDifferences) {
  Random random(804);
  double worst = 0;
  int kinks = 0;
  const int rooms = CaseCount(1500);
  for (int i = 0; i < rooms; ++i) {
    const Motion motion = RandomMotion(random, i % 2 == 0 ? 0 : 3);
    ExpectGradient(Mapped(BrightRoom(random, 1 + static_cast<int>(random.Index(6))), motion), motion, random,
                   worst, kinks);
  }
  std::printf("seed 804, largest difference %.2g W/m^3, %d of %d at a kink\n", worst, kinks, rooms * 9);
  EXPECT_LE(kinks, rooms / 3);
}

// Over a square light the gradient has a closed form: none along the light on its axis, and as steep above as
// the form factor's derivative, F = 4 a / (pi c) atan(a / c), c = sqrt(h^2 + a^2), from the axis at height h.
TEST(PointIrradiance, GradientOverSquare) {
  Scene scene;
  const std::int32_t light = AddMaterial(scene, 0, 1);
  Add(scene, {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, light);
  const PatchVisibility unused;
  const PointIrradiance irradiance(scene, unused, SourceSet::Emitters(scene));
  IrradianceParts parts;
  const double got = irradiance.Anywhere(Receiver(Vec3::Zero(), Vec3::UnitZ()), &parts).irradiance[0];
  const double c = std::sqrt(5.0), h = 2;
  EXPECT_NEAR(got, 4 / (std::numbers::pi * c) * std::atan(1 / c), 1e-15);
  // d/dc (atan(1/c) / c) = -atan(1/c) / c^2 - 1 / (c (c^2 + 1)), dc/dh = h / c, and the point rises as h
  // falls.
  const double want = 4 / std::numbers::pi * (std::atan(1 / c) / (c * c) + 1 / (c * (c * c + 1))) * h / c;
  EXPECT_NEAR(parts.gradient(0, 2), want, 1e-15);
  EXPECT_NEAR(parts.gradient(0, 0), 0, 1e-16);
  EXPECT_NEAR(parts.gradient(0, 1), 0, 1e-16);
}

// Backprojection that collapses segments: nothing where there are none so short, something where all are.
TEST(PointIrradiance, ShortSegmentsOfBackprojections) {
  Random random(806);
  double same = 0, other = 0;
  for (int i = 0; i < 20; ++i) {
    const Scene scene = BrightRoom(random, 4);
    const PatchVisibility unused;
    const SourceSet sources = SourceSet::Emitters(scene);
    PointIrradianceOptions fine, coarse;
    fine.min_backprojection_segment = 1e-9;
    coarse.min_backprojection_segment = 0.3;
    const PointIrradiance exact(scene, unused, sources), finely(scene, unused, sources, fine),
        coarsely = PointIrradiance(scene, unused, sources, coarse).WithSources(sources);
    const ReceiverPoint at = Receiver(PointInRoom(random), RandomDirection(random));
    const Rgb want = exact.Anywhere(at).irradiance;
    same = std::max(same, (finely.Anywhere(at).irradiance - want).abs().maxCoeff());
    other = std::max(other, (coarsely.Anywhere(at).irradiance - want).abs().maxCoeff());
  }
  std::printf("seed 806, largest differences %.2g and %.2g W/m^2\n", same, other);
  EXPECT_LE(same, 1e-12);
  EXPECT_GE(other, 1e-4);
}

// The thesis's substitutes for limits: beside the foot of a bright wall the limit is 1/2; a nudge of d gives
// the value at d; a lifted wall leaves almost nothing at its foot.
TEST(PointIrradiance, NudgeAndPushOff) {
  Scene scene;
  const std::int32_t light = AddMaterial(scene, 0, 1);
  Add(scene, {{-5, 0, 0}, {-5, 0, 5}, {5, 0, 5}, {5, 0, 0}}, light);
  const PatchVisibility unused;
  const auto at_foot = [&](const PointIrradianceOptions& options) {
    return PointIrradiance(scene, unused, SourceSet::Emitters(scene), options)
        .Anywhere(Receiver(Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitY()))
        .irradiance[0];
  };
  EXPECT_NEAR(at_foot({}), 0.5, 1e-15);
  PointIrradianceOptions nudged;
  nudged.nudge = 1e-3;
  EXPECT_EQ(at_foot(nudged), Direct(scene, Receiver({0, 1e-3, 0}, Vec3::UnitZ())).irradiance[0]);
  EXPECT_NEAR(at_foot(nudged), 0.5, 1e-3);
  PointIrradianceOptions lifted = nudged;
  lifted.nudge = 1e-6;
  lifted.source_push_off = 1e-3;
  EXPECT_LT(at_foot(lifted), 1e-3);
}

}  // namespace
}  // namespace penumbra::scene_test
