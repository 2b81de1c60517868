// All exact methods find the same visible part of a source, whatever coincides.

#include "solver/visibility/occlusion_method.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "solver/base/parallel.h"
#include "solver/visibility/backprojection.h"
#include "solver/visibility/clipping.h"
#include "solver/visibility/form_factor.h"
#include "solver/visibility/point_view.h"
#include "solver/visibility/sampled_visibility.h"
#include "solver/visibility/vertex_tracing.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// A point and what it looks at, with every other patch as a blocker.
struct Case {
  Scene scene;
  ReceiverPoint at;
  std::vector<PatchId> sources;
  PatchId own = kNoPatch;
};

// Form factors by all exact methods, relative to the unoccluded source.
struct Compared {
  double whole = 0;  // the unoccluded form factor
  double clipping = 0, backprojection = 0, tracing = 0;
  double angle = 0;  // how large the source looks [rad], about
  int blockers = 0;
  TracedFormFactor traced;
};

template <class Body>
void CompareMethods(const Case& problem, const Body& body) {
  PointView view(problem.scene, problem.at);
  std::vector<PatchId> all;
  for (std::size_t p = 0; p < problem.scene.patches.size(); ++p) all.push_back(static_cast<PatchId>(p));
  for (const PatchId source : problem.sources) {
    if (source == problem.own || !view.FaceSource(source)) continue;
    const DirectionPolygon seen =
        view.SeeSource(problem.scene.patches[static_cast<std::size_t>(source)].Vertices());
    if (seen.empty()) continue;
    std::vector<Occluder> occluders;
    if (!view.FindBlockers(all, problem.own, seen, occluders) || occluders.empty()) continue;
    Compared c;
    c.whole = FormFactor(seen, problem.at.normal);
    if (c.whole <= 0) continue;
    c.blockers = static_cast<int>(occluders.size());
    c.clipping = Clipping().VisibleFormFactor(seen, occluders, problem.at.normal) / c.whole;
    c.backprojection = Backprojection().VisibleFormFactor(seen, occluders, problem.at.normal) / c.whole;
    c.traced = VertexTracing().Trace(seen, occluders, problem.at.normal);
    c.tracing = c.traced.form_factor / c.whole;
    for (int i = 0; i < seen.size(); ++i)
      for (int j = 0; j < i; ++j)
        c.angle = std::max(c.angle, std::atan2(seen[i].cross(seen[j]).norm(), seen[i].dot(seen[j])));
    body(c);
  }
}

std::vector<PatchId> AllPatches(const Scene& scene) {
  std::vector<PatchId> all;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) all.push_back(static_cast<PatchId>(p));
  return all;
}

// A parallelogram, trapezium or triangle about a point.
Polygon3 RandomPolygon(Random& random, const Vec3& centre, double size) {
  const Vec3 u = size * RandomDirection(random);
  Vec3 v = u.cross(RandomDirection(random));
  v *= size * random.LogUniform(0.1, 1) / std::max(v.norm(), 1e-3 * size);
  const double top = random.Uniform(0.2, 1), skew = random.Uniform(-1, 1);
  Polygon3 polygon = {centre - u - v, centre + u - v, centre + (top + skew) * u + v};
  if (random.Index(3) != 0) polygon.push_back(centre + (skew - top) * u + v);
  return polygon;
}

using Generator = Case (*)(Random& random);

// Sizes and distances from 1e-3 to 1e3, turned anyhow; blockers on the way to the source.
Case RandomSizes(Random& random) {
  Case problem;
  const std::int32_t grey = AddMaterial(problem.scene, 0.5, 0);
  const double distance = random.LogUniform(1e-3, 1e3);
  problem.at.normal = RandomDirection(random).normalized();
  const Vec3 towards = (RandomDirection(random) + 1.1 * problem.at.normal).normalized();
  const double size = std::min(random.LogUniform(1e-3, 1e3), 30 * distance);
  Polygon3 source = RandomPolygon(random, distance * towards, size);
  if ((source[1] - source[0]).cross(source[2] - source[0]).dot(source[0]) > 0)
    std::reverse(source.begin(), source.end());
  problem.sources = {Add(problem.scene, source, grey)};
  const int blockers = 1 + static_cast<int>(random.Index(12));
  for (int i = 0; i < blockers; ++i) {
    const double along = random.LogUniform(1e-3, 1);
    const Vec3 centre = along * (distance * towards + random.Uniform(0, 1.5) * size * RandomDirection(random));
    Add(problem.scene, RandomPolygon(random, centre, along * size * random.LogUniform(0.03, 3)), grey);
  }
  return problem;
}

// Rectangles and triangles with all vertices on a grid of eight cells, over a point on it.
Case OnGrid(Random& random) {
  Case problem;
  const std::int32_t grey = AddMaterial(problem.scene, 0.5, 0);
  problem.at.position = {static_cast<double>(random.Index(5)), static_cast<double>(random.Index(5)), 0};
  const auto add = [&](double z, double size) {
    const auto on_grid = [&] { return static_cast<double>(random.Index(9)) - 2; };
    const double x = on_grid(), y = on_grid(), w = 1 + random.Index(static_cast<std::uint32_t>(size)),
                 h = 1 + random.Index(static_cast<std::uint32_t>(size));
    Polygon3 polygon = {{x, y + h, z}, {x + w, y + h, z}, {x + w, y, z}, {x, y, z}};
    const std::uint32_t kind = random.Index(4);
    if (kind == 0) polygon.erase(polygon.begin() + random.Index(4));
    if (kind == 1) {
      // Upright instead.
      const double top = std::min(z + w, 7.0);
      polygon = {{x, y, z}, {x + w, y + h, z}, {x + w, y + h, top}, {x, y, top}};
      if (top <= z) return kNoPatch;
    }
    return Add(problem.scene, polygon, grey);
  };
  problem.sources = {add(8, 4)};
  if (problem.sources[0] == kNoPatch) problem.sources.clear();
  const int blockers = 2 + static_cast<int>(random.Index(12));
  for (int i = 0; i < blockers; ++i) add(1 + random.Index(6), 3);
  return problem;
}

// A furnished room from a point of the floor: any patch is a source.
Case Room(Random& random) {
  Case problem;
  problem.scene = FurnishedRoom(random, 1 + static_cast<int>(random.Index(8)));
  const bool grid = random.Index(2) == 0;
  const auto coordinate = [&] {
    return grid ? 0.25 * (1 + static_cast<double>(random.Index(15))) + 0.125 * random.Index(2)
                : random.Uniform(0.01, 3.99);
  };
  problem.at.position = {coordinate(), coordinate(), 0};
  problem.own = 0;
  for (int i = 0; i < 6; ++i)
    problem.sources.push_back(
        static_cast<PatchId>(random.Index(static_cast<std::uint32_t>(problem.scene.patches.size()))));
  problem.sources.push_back(static_cast<PatchId>(problem.scene.patches.size()) - 1);
  return problem;
}

// The same, turned and shifted, so that everything coincides but for rounding.
Case TurnedRoom(Random& random) {
  Case problem = Room(random);
  const Motion motion = RandomMotion(random, 3);
  problem.scene = Mapped(problem.scene, motion);
  problem.at.position = motion(problem.at.position);
  problem.at.normal = problem.scene.patches[0].normal;
  problem.at.uncertainty = HeightRounding(16);
  return problem;
}

// Points where boxes and walls stand on the floor, approached from all sides.
Case Contact(Random& random) {
  Case problem = Room(random);
  const auto& patches = problem.scene.patches;
  const Patch& patch = patches[random.Index(static_cast<std::uint32_t>(patches.size()))];
  const auto k = random.Index(static_cast<std::uint32_t>(patch.size));
  const Vec3 a = patch.vertex[k], b = patch.vertex[(k + 1) % static_cast<std::uint32_t>(patch.size)];
  const Vec3 p = random.Index(3) == 0 ? a : Vec3(a + 0.25 * random.Index(5) * (b - a));
  problem.at.position = {p.x(), p.y(), 0};
  const double angle = random.Index(2) == 0 ? random.Index(8) * std::numbers::pi / 4 + 0.1
                                            : random.Uniform(0, 2 * std::numbers::pi);
  problem.at.approach = {std::cos(angle), std::sin(angle), 0};
  problem.sources = AllPatches(problem.scene);
  return problem;
}

Case TurnedContact(Random& random) {
  Case problem = Contact(random);
  const Motion motion = RandomMotion(random, 3);
  problem.scene = Mapped(problem.scene, motion);
  problem.at.position = motion(problem.at.position);
  problem.at.approach = motion.turn * problem.at.approach;
  problem.at.normal = problem.scene.patches[0].normal;
  problem.at.uncertainty = HeightRounding(16);
  return problem;
}

struct Worst {
  double difference = 0;
  std::size_t index = 0;
  void Add(double value, std::size_t at) {
    if (!(value <= difference)) difference = value, index = at;
  }
};

// Compares the methods on `count` configurations; prints and returns the largest differences.
struct Summary {
  std::size_t compared = 0, formula = 0, borders = 0;
  Worst exact, clipping;
};

Summary CompareAll(const char* name, Generator make, std::uint64_t seed, std::size_t count) {
  std::vector<std::vector<Compared>> found(count);
  ParallelFor(count, 8, [&](std::size_t i) {
    Random random(seed, i);
    CompareMethods(make(random), [&](const Compared& c) { found[i].push_back(c); });
  });
  Summary s;
  for (std::size_t i = 0; i < count; ++i)
    for (const Compared& c : found[i]) if (std::abs(c.tracing - c.backprojection) > 2e-14) printf("  %zu: exact %.2g clip %.2g whole %g angle %g visible %g blockers %d borders %d formula %d\n", i, c.tracing-c.backprojection,c.clipping-c.backprojection,c.whole,c.angle,c.backprojection,c.blockers,int(c.traced.borders),int(c.traced.formula_borders));
  double tiny[8][8] = {};
  for (std::size_t i = 0; i < count; ++i)
    for (const Compared& c : found[i]) {
      ++s.compared;
      s.borders += static_cast<std::size_t>(c.traced.borders);
      s.formula += static_cast<std::size_t>(c.traced.formula_borders);
      s.exact.Add(std::abs(c.tracing - c.backprojection), i);
      s.clipping.Add(std::abs(c.clipping - c.backprojection), i);
      const auto bin = static_cast<std::size_t>(std::clamp(-std::log10(c.angle), 0.0, 7.0));
      const double obl = c.whole / (c.angle * c.angle);
      const auto g = static_cast<std::size_t>(std::clamp(-std::log10(obl), 0.0, 7.0));
      tiny[bin][g] = std::max(tiny[bin][g], std::abs(c.clipping - c.backprojection));
    }
  std::printf(
      "%-14s seed %llu, %zu compared: exact methods differ by %.2g (sequence %zu), clipping by %.2g "
      "(sequence %zu); paper's formula %.0f%%\n",
      name, static_cast<unsigned long long>(seed), s.compared, s.exact.difference, s.exact.index,
      s.clipping.difference, s.clipping.index,
      100.0 * static_cast<double>(s.formula) / std::max<double>(1, static_cast<double>(s.borders)));
  for (int i = 0; i < 8; ++i) {for (int j=0;j<8;++j) std::printf(" %8.1g", tiny[i][j]); std::printf("\n");}
  return s;
}

TEST(OcclusionMethod, RandomSizes) { CompareAll("random sizes", RandomSizes, 601, 3000); }
TEST(OcclusionMethod, OnGrid) { CompareAll("grid", OnGrid, 602, 2000); }
TEST(OcclusionMethod, Room) { CompareAll("room", Room, 603, 500); }
TEST(OcclusionMethod, TurnedRoom) { CompareAll("turned room", TurnedRoom, 604, 500); }
TEST(OcclusionMethod, Contact) { CompareAll("contact", Contact, 605, 200); }
TEST(OcclusionMethod, TurnedContact) { CompareAll("turned contact", TurnedContact, 606, 200); }

}  // namespace
}  // namespace penumbra::scene_test
