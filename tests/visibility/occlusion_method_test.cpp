// All exact methods find the same visible part of a source, whatever coincides.

#include "solver/visibility/point/occlusion_method.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <memory>

#include "solver/base/parallel.h"
#include "solver/visibility/exact/backprojection.h"
#include "solver/visibility/exact/occlusion_methods.h"
#include "solver/visibility/exact/vertex_tracing.h"
#include "solver/visibility/point/clipping.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/point_view.h"
#include "solver/visibility/point/sampled_visibility.h"
#include "tests/cases.h"
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
    c.clipping = Clipping().VisibleFormFactor(seen, occluders, problem.at.normal) / c.whole;
    c.backprojection = Backprojection().VisibleFormFactor(seen, occluders, problem.at.normal) / c.whole;
    c.traced = VertexTracing().Trace(seen, occluders, problem.at.normal);
    c.tracing = c.traced.form_factor / c.whole;
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
    const Vec3 centre =
        along * (distance * towards + random.Uniform(0, 1.5) * size * RandomDirection(random));
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

// The same, anywhere up to a million times as far from the origin as the source is from the point.
Case RandomSizesFarAway(Random& random) {
  Case problem = RandomSizes(random);
  const double far = problem.scene.patches[0].vertex[0].norm() * random.LogUniform(1, 1e6);
  const Vec3 shift = far * RandomDirection(random);
  problem.at.position += shift;
  problem.scene = Mapped(problem.scene, [&](const Vec3& p) { return Vec3(p + shift); });
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
  std::size_t sequence = 0;
  void Add(double value, std::size_t at) {
    if (!(value <= difference)) difference = value, sequence = at;
  }
};

// Makes cases and compares the methods on them.
void CompareAll(const char* name, Generator make, std::uint64_t seed, int cases) {
  const auto count = static_cast<std::size_t>(CaseCount(cases));
  std::vector<std::vector<Compared>> found(count);
  ParallelFor(count, 8, [&](std::size_t i) {
    Random random(seed, i);
    CompareMethods(make(random), [&](const Compared& c) { found[i].push_back(c); });
  });
  std::size_t compared = 0, formula = 0, borders = 0;
  Worst exact, clipping;
  for (std::size_t i = 0; i < count; ++i)
    for (const Compared& c : found[i]) {
      ++compared;
      borders += static_cast<std::size_t>(c.traced.borders);
      formula += static_cast<std::size_t>(c.traced.formula_borders);
      exact.Add(std::abs(c.tracing - c.backprojection), i);
      clipping.Add(std::abs(c.clipping - c.backprojection), i);
    }
  std::printf(
      "%s, seed %llu: %zu compared; backprojection and vertex tracing differ by up to %.2g (sequence %zu), "
      "clipping by %.2g (sequence %zu), bound %.2g; paper's formula for %.0f%% of the borders\n",
      name, static_cast<unsigned long long>(seed), compared, exact.difference, exact.sequence,
      clipping.difference, clipping.sequence, kOcclusionError,
      100.0 * static_cast<double>(formula) / std::max(1.0, static_cast<double>(borders)));
  EXPECT_GT(compared, 0U);
  EXPECT_LE(exact.difference, kOcclusionError);
  EXPECT_LE(clipping.difference, kOcclusionError);
}

TEST(OcclusionMethod, AgreeForAnySizes) { CompareAll("any sizes", RandomSizes, 601, 2000); }
TEST(OcclusionMethod, AgreeOnGrids) { CompareAll("grid", OnGrid, 602, 40000); }
TEST(OcclusionMethod, AgreeInRooms) { CompareAll("room", Room, 603, 2000); }
TEST(OcclusionMethod, AgreeInTurnedRooms) { CompareAll("turned room", TurnedRoom, 604, 1000); }
TEST(OcclusionMethod, AgreeInContact) { CompareAll("contact", Contact, 605, 700); }
TEST(OcclusionMethod, AgreeInTurnedContact) { CompareAll("turned contact", TurnedContact, 606, 200); }

TEST(OcclusionMethod, AgreeFarFromTheOrigin) {
  CompareAll("far from the origin", RandomSizesFarAway, 607, 2000);
}

// The quarters of sources in one image, against one after the other. Far from the origin and beside the
// horizon, too; sources that fit into no image go one by one.
TEST(OcclusionMethod, PartsTogetherAreAsPartsAlone) {
  std::size_t compared = 0;
  double worst = 0;
  for (const Generator generator : {RandomSizes, Room, TurnedRoom, Contact})
    for (std::uint64_t i = 0; i < 500; ++i) {
      Random random(611, i);
      const Case problem = generator(random);
      PointView view(problem.scene, problem.at);
      for (const PatchId source : problem.sources) {
        const std::span<const Vec3> v = problem.scene.patches[static_cast<std::size_t>(source)].Vertices();
        if (source == problem.own || v.size() != 4 || !view.FaceSource(source)) continue;
        const DirectionPolygon whole = view.SeeSource(v);
        std::vector<Occluder> occluders;
        if (whole.empty() || !view.FindBlockers(AllPatches(problem.scene), problem.own, whole, occluders))
          continue;
        const Vec3 centre = 0.25 * (v[0] + v[1] + v[2] + v[3]);
        std::array<DirectionPolygon, 4> parts;
        std::array<double, 4> together;
        for (std::size_t q = 0; q < 4; ++q)
          parts[q] = view.SeeSource(std::array<Vec3, 4>{v[q], 0.5 * (v[q] + v[(q + 1) % 4]), centre,
                                                        0.5 * (v[q] + v[(q + 3) % 4])});
        VisibleFormFactors(whole, parts, occluders, problem.at.normal, together);
        for (std::size_t q = 0; q < 4; ++q) {
          const double alone = Clipping().VisibleFormFactor(parts[q], occluders, problem.at.normal);
          worst = std::max(worst, std::abs(together[q] - alone) / FormFactor(whole, problem.at.normal));
          ++compared;
        }
      }
    }
  std::printf("seed 611: %zu parts, largest difference %.2g of the whole source (bound %.2g)\n", compared,
              worst, kOcclusionError);
  EXPECT_GT(compared, 2000U);
  EXPECT_LE(worst, kOcclusionError);
}

// Closed cases, seen from the origin, which looks up.

const Vec3 kUp = Vec3::UnitZ();

// Rectangles at height z.
DirectionPolygon Rectangle(double x0, double y0, double x1, double y1, double z) {
  DirectionPolygon polygon;
  for (const Vec3& v : {Vec3(x0, y0, z), Vec3(x1, y0, z), Vec3(x1, y1, z), Vec3(x0, y1, z)}) polygon.Add(v);
  return polygon;
}

Cone ConeOf(const DirectionPolygon& polygon) { return MakeCone({}, polygon, 1); }

struct Named {
  const char* name;
  std::unique_ptr<const OcclusionMethod> method;
};

std::vector<Named> ExactMethods() {
  std::vector<Named> methods;
  for (const char* name : {"clipping", "backprojection", "vertex-tracing"})
    methods.push_back({name, OcclusionMethods().Make(name, {})});
  return methods;
}

std::vector<Occluder> Whole(const std::vector<Cone>& cones) { return {cones.begin(), cones.end()}; }

TEST(OcclusionMethod, NamesAreKnown) {
  for (const std::string& name : OcclusionMethods().Names())
    EXPECT_NE(OcclusionMethods().Make(name, {}), nullptr);
  EXPECT_NE(OcclusionMethods().Make("sampled", {}), nullptr);
  EXPECT_THROW(OcclusionMethods().Make("guess", {}), InputError);
}

// A blocker over one half of a source overhead leaves half of it, however small the source.
TEST(OcclusionMethod, HalfCovered) {
  double worst = 0;
  for (const Named& exact : ExactMethods())
    for (const double size : {100.0, 1.0, 1e-2, 1e-4, 1e-6, 1e-8}) {
      const DirectionPolygon source = Rectangle(-size, -size, size, size, 1);
      const std::vector<Cone> cones = {ConeOf(Rectangle(0, -2 * size, 3 * size, size, 0.5))};
      const double half = exact.method->VisibleFormFactor(source, Whole(cones), kUp);
      EXPECT_NEAR(half / FormFactor(source, kUp), 0.5, 1e-13) << exact.name << ", size " << size;
      worst = std::max(worst, std::abs(half / FormFactor(source, kUp) - 0.5));
    }
  std::printf("largest error %.2g (bound 1e-13)\n", worst);
}

// A blocker in the middle takes its own form factor away.
TEST(OcclusionMethod, RingIsDifference) {
  for (const Named& exact : ExactMethods()) {
    const DirectionPolygon source = Rectangle(-1, -1, 2, 1, 1), hole = Rectangle(0, -0.25, 0.5, 0.25, 0.5);
    const std::vector<Cone> cones = {ConeOf(hole)};
    EXPECT_NEAR(exact.method->VisibleFormFactor(source, Whole(cones), kUp),
                FormFactor(source, kUp) - FormFactor(hole, kUp), 1e-15)
        << exact.name;
  }
}

// Sixteen abutting squares leave exactly nothing, and fifteen the form factor of the last.
TEST(OcclusionMethod, AbuttingSquaresLeaveNothing) {
  for (const Named& exact : ExactMethods())
    for (const double scale : {1.0, 0.1, 1.0 / 3}) {
      const double a = 4 * scale;
      const DirectionPolygon source = Rectangle(-a, -a, a, a, 3);
      std::vector<Cone> cones;
      for (int i = -2; i < 2; ++i)
        for (int j = -2; j < 2; ++j)
          cones.push_back(ConeOf(Rectangle(i * scale, j * scale, (i + 1) * scale, (j + 1) * scale, 1.5)));
      EXPECT_EQ(exact.method->VisibleFormFactor(source, Whole(cones), kUp), 0) << exact.name;
      cones.erase(cones.begin() + 6);
      EXPECT_NEAR(exact.method->VisibleFormFactor(source, Whole(cones), kUp),
                  FormFactor(Rectangle(-scale, 0, 0, scale, 1.5), kUp), 1e-15)
          << exact.name;
    }
}

// A blocker that the source looks the same as covers exactly all of it.
TEST(OcclusionMethod, SameOutlineCoversAll) {
  Random random(608);
  for (const Named& exact : ExactMethods())
    for (int i = 0; i < 200; ++i) {
      const double x = random.Uniform(-2, 2), y = random.Uniform(-2, 2), size = random.LogUniform(1e-6, 2);
      const DirectionPolygon source = Rectangle(x, y, x + size, y + size, 1);
      DirectionPolygon blocker;
      for (int k = 0; k < 4; ++k) blocker.Add(0.5 * source[k]);
      const std::vector<Cone> cones = {ConeOf(blocker)};
      EXPECT_EQ(exact.method->VisibleFormFactor(source, Whole(cones), kUp), 0) << exact.name << ", " << i;
    }
}

// Blockers at different heights whose edges run through one point of the source, seen three at a time: what
// they leave is a triangle, or nothing.
TEST(OcclusionMethod, ThreeEdgesThroughOnePoint) {
  const DirectionPolygon source = Rectangle(-1, -1, 1, 1, 1);
  const auto triangle = [](const Vec3& a, const Vec3& b, const Vec3& c, double height) {
    DirectionPolygon polygon;
    for (const Vec3& v : {a, b, c}) polygon.Add(height * v);
    return polygon;
  };
  // Lines through (0.25, 0): upright, and two diagonals.
  const Vec3 centre(0.25, 0, 1), up(0.25, 8, 1), down(0.25, -8, 1), left_up(-8, 8.25, 1),
      left_down(-8, -8.25, 1);
  std::vector<Cone> cones;
  cones.push_back(ConeOf(triangle(down, Vec3(16, 0, 1), up, 0.5)));            // all to the right
  cones.push_back(ConeOf(triangle(centre, up, left_up, 0.25)));                // upper left
  cones.push_back(ConeOf(triangle(left_down, down, Vec3(4.25, 4, 1), 0.75)));  // all below the one diagonal
  // Left of the centre remain the directions between the diagonals, cut off by the source's left edge.
  const DirectionPolygon rest =
      triangle(centre, Vec3(-1, 1.25, 1), Vec3(-1, -1.25, 1), 1);  // and above and below by its others
  std::vector<Cone> outside;
  outside.push_back(ConeOf(Rectangle(-2, 1, 2, 3, 1)));
  outside.push_back(ConeOf(Rectangle(-2, -3, 2, -1, 1)));
  for (const Named& exact : ExactMethods()) {
    const double left = exact.method->VisibleFormFactor(source, Whole(cones), kUp);
    EXPECT_NEAR(left, exact.method->VisibleFormFactor(rest, Whole(outside), kUp), 1e-15) << exact.name;
    EXPECT_GT(left, 0.05);
    std::vector<Cone> all = cones;
    all.push_back(ConeOf(triangle(centre, left_up, left_down, 0.125)));
    EXPECT_EQ(exact.method->VisibleFormFactor(source, Whole(all), kUp), 0) << exact.name;
  }
}

// The data of a backprojection: triangles fill the source, visible ones make up its visible form factor, and
// every edge between a visible and a hidden one lies on a blocker's outline.
TEST(Backprojection, DataIsWhatItAddsUp) {
  Random random(609);
  for (int i = 0; i < CaseCount(200); ++i) {
    const DirectionPolygon source = Rectangle(-1, -1, 1, 1, random.LogUniform(0.5, 10));
    std::vector<Cone> cones;
    for (int k = 0; k < 6; ++k) {
      const double x = 0.25 * random.Index(8) - 1, y = 0.25 * random.Index(8) - 1;
      cones.push_back(ConeOf(Rectangle(x, y, x + 0.5, y + 0.25 + 0.25 * random.Index(3), source[0].z())));
    }
    const Backprojection method;
    const BackprojectedSource data = method.Project(source, Whole(cones), kUp);
    double whole = 0, visible = 0;
    std::vector<std::array<std::int32_t, 2>> border;
    for (const BackprojectedSource::Triangle& t : data.triangle) {
      DirectionPolygon polygon;
      for (const std::int32_t v : t.vertex) polygon.Add(data.vertex[static_cast<std::size_t>(v)]);
      whole += FormFactor(polygon, kUp);
      if (!t.visible) continue;
      visible += FormFactor(polygon, kUp);
      for (std::size_t k = 0; k < 3; ++k) border.push_back({t.vertex[k], t.vertex[(k + 1) % 3]});
    }
    EXPECT_NEAR(whole, FormFactor(source, kUp), 1e-14);
    EXPECT_NEAR(visible, method.VisibleFormFactor(source, Whole(cones), kUp), 1e-15);
    for (const auto& [a, b] : border) {
      if (std::find(border.begin(), border.end(), std::array{b, a}) != border.end()) continue;
      const Vec3 &p = data.vertex[static_cast<std::size_t>(a)], &q = data.vertex[static_cast<std::size_t>(b)];
      const Vec2 u = source[0].z() / p.z() * p.head<2>(), v = source[0].z() / q.z() * q.head<2>();
      const auto beside = [](double x, double y) {
        return std::abs(std::abs(x) - 1) < 1e-14 && std::abs(y - x) < 1e-14;
      };
      const bool on_source = beside(u.x(), v.x()) || beside(u.y(), v.y());
      const bool on_blocker =
          std::any_of(data.blocker_edge.begin(), data.blocker_edge.end(),
                      [&](const auto& edge) { return edge.a == std::min(a, b) && edge.b == std::max(a, b); });
      EXPECT_TRUE(on_source || on_blocker) << p.transpose() << " to " << q.transpose();
    }
    for (const BackprojectedSource::BlockerEdge& edge : data.blocker_edge) {
      const Cone& cone = cones[static_cast<std::size_t>(edge.occluder)];
      const Vec3 middle =
          data.vertex[static_cast<std::size_t>(edge.a)] + data.vertex[static_cast<std::size_t>(edge.b)];
      double lowest = 1;
      for (int k = 0; k < cone.size; ++k)
        lowest = std::min(lowest, cone.normal[static_cast<std::size_t>(k)].dot(middle));
      EXPECT_NEAR(lowest, 0, 1e-14);
    }
  }
}

// Collapsing short segments changes no more than the strips beside them.
TEST(Backprojection, ShortSegmentsMatterLittle) {
  const DirectionPolygon source = Rectangle(-1, -1, 1, 1, 1);
  // A cut corner of length 0.01 sqrt 2, against the source's diameter 2 sqrt 2.
  DirectionPolygon blocker;
  for (const Vec3& v :
       {Vec3(-0.5, -0.5, 1), Vec3(0.5, -0.5, 1), Vec3(0.5, 0.49, 1), Vec3(0.49, 0.5, 1), Vec3(-0.5, 0.5, 1)})
    blocker.Add(v);
  const std::vector<Cone> cones = {ConeOf(blocker)};
  const double all = Backprojection().VisibleFormFactor(source, Whole(cones), kUp);
  EXPECT_EQ(Backprojection(0.004).VisibleFormFactor(source, Whole(cones), kUp), all);
  const double fewer = Backprojection(0.006).VisibleFormFactor(source, Whole(cones), kUp);
  EXPECT_NE(fewer, all);
  EXPECT_NEAR(fewer, all, 0.006);
  EXPECT_LT(Backprojection(0.006).Project(source, Whole(cones), kUp).blocker_edge.size(),
            Backprojection().Project(source, Whole(cones), kUp).blocker_edge.size());
}

// The paper's formula and the sum over edges are the same integral: both are in use and agree with clipping,
// by the tests above. A large source uses the first, a small one cannot.
TEST(VertexTracing, UsesThePapersFormulaWhereItIsAccurate) {
  for (const double size : {1.0, 1e-4}) {
    const DirectionPolygon source = Rectangle(-size, -size, size, size, 1);
    const std::vector<Cone> cones = {ConeOf(Rectangle(0, -2 * size, 3 * size, 0.25 * size, 0.5))};
    const TracedFormFactor traced = VertexTracing().Trace(source, Whole(cones), kUp);
    EXPECT_EQ(traced.vertices, 6);
    EXPECT_EQ(traced.borders, 12);
    EXPECT_EQ(traced.formula_borders, size == 1 ? 12 : 0);
  }
}

// Sampling tends to the exact value as the parts get smaller: parts that a shadow's edge runs through are off
// by no more than themselves. Triangles too; what nothing covers is exact.
TEST(SampledVisibility, TendsToTheExactValue) {
  Random random(610);
  for (int i = 0; i < 100; ++i) {
    DirectionPolygon source = Rectangle(-1, -1, 1, 1, 2);
    if (i % 2 == 1) {
      source.clear();
      for (const Vec3& v : {Vec3(-1, -1, 2), Vec3(1, -1, 2), Vec3(0, 1, 2)}) source.Add(v);
    }
    EXPECT_NEAR(SampledVisibility().VisibleFormFactor(source, {}, kUp), FormFactor(source, kUp), 1e-14);
    const double x = random.Uniform(-1, 0.5), y = random.Uniform(-1, 0.5);
    const std::vector<Cone> cones = {ConeOf(Rectangle(x, y, x + 0.5, y + 0.3, 1))};
    const double exact = Backprojection().VisibleFormFactor(source, Whole(cones), kUp);
    for (const int n : {4, 16, 64})
      EXPECT_NEAR(SampledVisibility(n).VisibleFormFactor(source, Whole(cones), kUp) / FormFactor(source, kUp),
                  exact / FormFactor(source, kUp), 4.0 / n)
          << n;
  }
}

}  // namespace
}  // namespace penumbra::scene_test
