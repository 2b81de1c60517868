// Rows of form factors: irradiance as a product, for the light of today and for another.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "mesh/interpolants/sample_cache.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene_parts.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/points/factor_row.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

constexpr double kTolerance = 0.004;

// A solved room with a box, a lamp and a panel that sends nothing, and points on its surfaces.
struct RecordedRoom {
  RecordedRoom() : scene(Room()), pipeline(scene, Options()) {
    pipeline.Solve({});
    for (const SurfacePoint& p : SpreadPoints(scene, ReflectingAreas(scene), 300, 5)) {
      patches.push_back(p.patch);
      at.emplace_back();
      at.back().position = p.position;
      at.back().normal = scene.patches[static_cast<std::size_t>(p.patch)].normal;
    }
  }
  static Scene Room() {
    Scene scene;
    const std::int32_t grey = AddMaterial(scene, 0.5, 0), lamp = AddMaterial(scene, 0, 40),
                       black = AddMaterial(scene, 0, 0);
    AddBox(scene, Vec3::Zero(), {4, 3, 2.5}, true, grey);
    AddBox(scene, {1, 1, 0}, {2, 2, 1}, false, grey);
    Add(scene, {{2.5, 1, 2.25}, {2.5, 2, 2.25}, {3.5, 2, 2.25}, {3.5, 1, 2.25}}, lamp);
    Add(scene, {{0.5, 0.5, 1.5}, {0.5, 1.5, 1.5}, {0.5, 1.5, 2}, {0.5, 0.5, 2}}, black);
    return scene;
  }
  static PipelineOptions Options() {
    PipelineOptions options;
    options.error = 0.05;
    options.refine = RefineBy::kTransport;
    return options;
  }

  // A cache with rows of all points, for the present light.
  SampleCache Recorded() {
    SampleCache cache;
    for (std::size_t i = 0; i < at.size(); ++i)
      cache.Insert(patches[i], at[i], pipeline.irradiance().RecordOnPatch(patches[i], at[i], kTolerance));
    return cache;
  }
  // The 99th percentile of the relative differences between the cache and exact irradiance.
  double Difference(const SampleCache& cache, const PointIrradiance& exact) const {
    std::vector<double> differences;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Rgb want = exact.OnPatch(patches[i], at[i]).irradiance,
                got = cache.Find(patches[i], at[i])->irradiance;
      differences.push_back(((got - want).abs() / want).maxCoeff());
    }
    std::sort(differences.begin(), differences.end());
    return differences[differences.size() * 99 / 100];
  }
  std::size_t SourcesOf(const SampleCache& cache) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < at.size(); ++i) count += cache.Find(patches[i], at[i])->row->sources.size();
    return count;
  }

  Scene scene;
  Pipeline pipeline;
  std::vector<PatchId> patches;
  std::vector<ReceiverPoint> at;
};

// The light of every patch times a factor of its own and of each channel.
RadiositySolution Coloured(RadiositySolution solution, double least, double most, std::uint64_t seed) {
  Random random(seed);
  std::vector<Rgb> factor;
  for (std::size_t p = 0; p < solution.forest.scene().patches.size(); ++p)
    factor.emplace_back(random.Uniform(least, most), random.Uniform(least, most),
                        random.Uniform(least, most));
  for (std::size_t e = 0; e < solution.forest.size(); ++e)
    solution.radiosity[e] *= factor[static_cast<std::size_t>(solution.forest.elements()[e].patch)];
  for (Fragment& fragment : solution.fragments)
    fragment.radiosity *= factor[static_cast<std::size_t>(solution.forest[fragment.leaf].patch)];
  return solution;
}

TEST(FactorRow, GivesTheIrradiance) {
  RecordedRoom room;
  const SampleCache cache = room.Recorded();
  const double difference = room.Difference(cache, room.pipeline.irradiance());
  std::printf("p99 of the difference from exact irradiance %.2g\n", difference);
  EXPECT_LE(difference, kTolerance);
}

TEST(FactorRow, IsLinear) {
  RecordedRoom room;
  const RadiositySolution &one = room.pipeline.solution(), other = Coloured(one, 0.2, 5, 11);
  RadiositySolution both = one;
  for (std::size_t e = 0; e < both.radiosity.size(); ++e) both.radiosity[e] += 3 * other.radiosity[e];
  for (std::size_t f = 0; f < both.fragments.size(); ++f)
    both.fragments[f].radiosity += 3 * other.fragments[f].radiosity;
  const SourceSet a = SourceSet::FromSolution(one), b = SourceSet::FromSolution(other),
                  sum = SourceSet::FromSolution(both);
  const SampleCache cache = room.Recorded();
  constexpr double kSingle = 1e-5;  // some hundred terms of single numbers, 6e-8 each
  double worst = 0;
  for (std::size_t i = 0; i < room.at.size(); ++i) {
    const FactorRow& row = *cache.Find(room.patches[i], room.at[i])->row;
    const Rgb want = Irradiance(row, a) + 3 * Irradiance(row, b);
    worst = std::max(worst, ((Irradiance(row, sum) - want).abs() / want).maxCoeff());
  }
  std::printf("largest difference %.2g\n", worst);
  EXPECT_LE(worst, kSingle);
}

struct Relit {
  std::size_t all = 0, gathered = 0;  // sources of all points, and those of them that were gathered anew
  double difference = 0;
};

// Gives samples of the room's light that of another solution.
Relit RelightTo(RecordedRoom& room, const RadiositySolution& other) {
  SampleCache cache = room.Recorded();
  Relit relit;
  relit.all = room.SourcesOf(cache);
  const PointIrradiance& before = room.pipeline.irradiance();
  const PointIrradiance now = before.WithSources(SourceSet::FromSolution(other));
  relit.gathered = cache.Relight(before.sources(), now, kTolerance, {});
  relit.difference = room.Difference(cache, now);
  std::printf("%zu of %zu sources gathered, p99 of the difference %.2g\n", relit.gathered, relit.all,
              relit.difference);
  return relit;
}

// Another light over the same sources is a product: nearly nothing is gathered anew, and the values are
// right.
TEST(SampleCache, RelightsByProducts) {
  RecordedRoom room;
  const Relit relit = RelightTo(room, Coloured(room.pipeline.solution(), 0.7, 1.4, 12));
  EXPECT_LE(relit.gathered, relit.all / 50);
  EXPECT_LE(relit.difference, 2 * kTolerance);
}

// Where the new light varies within what was one source, that source is gathered anew.
TEST(SampleCache, GathersWhatNoLongerHolds) {
  RecordedRoom room;
  RadiositySolution other = room.pipeline.solution();
  Random random(13);
  for (const ElementId leaf : other.forest.AllLeaves())
    other.radiosity[static_cast<std::size_t>(leaf)] *= random.Uniform(0.2, 2);
  const Relit relit = RelightTo(room, other);
  EXPECT_GT(relit.gathered, relit.all / 50);
  EXPECT_LE(relit.difference, 2 * kTolerance);
}

// A patch that sent nothing has no terms; when it lights up, they are gathered.
TEST(SampleCache, FindsNewSources) {
  RecordedRoom room;
  SampleCache cache = room.Recorded();
  RadiositySolution other = room.pipeline.solution();
  const auto panel = static_cast<PatchId>(room.scene.patches.size() - 1);
  for (std::size_t e = 0; e < other.forest.size(); ++e)
    if (other.forest.elements()[e].patch == panel) other.radiosity[e] = Rgb(30, 20, 10);
  const PointIrradiance& before = room.pipeline.irradiance();
  ASSERT_TRUE(before.sources().Tree(panel).empty());
  const PointIrradiance now = before.WithSources(SourceSet::FromSolution(other));
  const std::size_t gathered = cache.Relight(before.sources(), now, kTolerance, {});
  const double difference = room.Difference(cache, now);
  std::printf("%zu gathered, p99 of the difference %.2g\n", gathered, difference);
  EXPECT_GT(gathered, std::size_t{0});
  EXPECT_LE(difference, 2 * kTolerance);
  // And back: terms of patches that send nothing any more are dropped.
  cache.Relight(now.sources(), before, kTolerance, {});
  EXPECT_LE(room.Difference(cache, before), 2 * kTolerance);
}

}  // namespace
}  // namespace penumbra::scene_test
