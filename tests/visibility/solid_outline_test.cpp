// The outline of a solid hides what its sides hide one by one.

#include "solver/visibility/point/solid_outline.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "solver/scene/convex_solids.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/point_view.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// What a point sees of each patch past all others.
std::vector<double> VisibleFactors(const Scene& scene, const ReceiverPoint& at, PatchId own,
                                   std::size_t* occluded) {
  PointView view(scene, at);
  std::vector<PatchId> all;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) all.push_back(static_cast<PatchId>(p));
  std::vector<double> factors(all.size(), 0);
  for (const PatchId source : all) {
    if (source == own || !view.FaceSource(source)) continue;
    const DirectionPolygon seen = view.SeeSource(scene.patches[static_cast<std::size_t>(source)].Vertices());
    std::vector<Occluder> occluders;
    if (seen.empty() || !view.FindBlockers(all, own, seen, occluders)) continue;
    *occluded += occluders.size();
    factors[static_cast<std::size_t>(source)] = view.VisibleFormFactor(seen, occluders);
  }
  return factors;
}

struct Comparison {
  double worst = 0;
  std::size_t one_by_one = 0, outlines = 0;

  void Compare(const Scene& with_solids, const ReceiverPoint& at, PatchId own) {
    Scene without = with_solids;
    without.solids.clear();
    without.solid_of.clear();
    const std::vector<double> expected = VisibleFactors(without, at, own, &one_by_one),
                              got = VisibleFactors(with_solids, at, own, &outlines);
    for (std::size_t i = 0; i < got.size(); ++i) {
      EXPECT_NEAR(got[i], expected[i], 2 * kOcclusionError)
          << "patch " << i << " from " << at.position.transpose() << ", on " << own;
      worst = std::max(worst, std::abs(got[i] - expected[i]));
    }
  }
  void Print(const char* what, std::uint64_t seed) const {
    std::printf("%s, seed %llu: largest difference %.2g; %zu occluders, %zu one by one\n", what,
                static_cast<unsigned long long>(seed), worst, outlines, one_by_one);
  }
};

ReceiverPoint ReceiverOn(const Patch& patch, Random& random) {
  ReceiverPoint at;
  const double u = random.Uniform(0.01, 0.99), v = random.Uniform(0.01, 0.99);
  at.position = patch.vertex[0] + u * (patch.vertex[1] - patch.vertex[0]) +
                (patch.size == 4 ? v : v * (1 - u)) * (patch.vertex[patch.size - 1] - patch.vertex[0]);
  at.normal = patch.normal;
  if (random.Index(2) == 0) at.approach = patch.normal.cross(RandomDirection(random));
  return at;
}

// Rooms whose boxes' planes, edges and corners coincide again and again, with some sides missing, as they are
// and turned; points on all surfaces, with and without an approach.
TEST(SolidOutline, HidesWhatItsSidesHide) {
  constexpr std::uint64_t kSeed = 20260102;
  Random random(kSeed);
  Comparison comparison;
  for (int i = 0; i < 150; ++i) {
    Scene scene = FurnishedRoom(random, 1 + i % 7);
    for (std::size_t p = scene.patches.size() - 1; p > 6; --p)
      if (random.Index(6) == 0)
        scene.patches.erase(scene.patches.begin() + static_cast<std::ptrdiff_t>(p) - 1);
    scene =
        i % 2 == 0 ? Mapped(scene, [](const Vec3& v) { return v; }) : Mapped(scene, RandomMotion(random, 10));
    for (int k = 0; k < 12; ++k) {
      const auto own = static_cast<PatchId>(random.Index(static_cast<std::uint32_t>(scene.patches.size())));
      comparison.Compare(scene, ReceiverOn(scene.patches[static_cast<std::size_t>(own)], random), own);
    }
  }
  comparison.Print("rooms", kSeed);
  EXPECT_LT(3 * comparison.outlines, 2 * comparison.one_by_one);
}

// A frustum over a regular polygon, or a pyramid; some sides may be missing.
void AddFrustum(Scene& scene, Random& random, const Motion& motion) {
  const int n = 3 + static_cast<int>(random.Index(4));
  const double height = random.LogUniform(0.05, 2), base = random.LogUniform(0.05, 1),
               top = random.Index(3) == 0 ? 0 : base * random.Uniform(0.2, 1.5);
  const auto corner = [&](int i, double r, double z) {
    const double angle = 2 * std::numbers::pi * (i % n) / n;
    return motion({r * std::cos(angle), r * std::sin(angle), z});
  };
  Polygon3 below, above;
  for (int i = 0; i < n; ++i) {
    below.insert(below.begin(), corner(i, base, 0));
    above.push_back(corner(i, top, height));
    Polygon3 side = {corner(i, base, 0), corner(i + 1, base, 0), corner(i + 1, top, height)};
    if (top > 0) side.push_back(corner(i, top, height));
    if (random.Index(12) != 0) Add(scene, side, 0);
  }
  if (n <= 4 && random.Index(2) == 0) Add(scene, below, 0);
  if (n <= 4 && top > 0 && random.Index(2) == 0) Add(scene, above, 0);
}

TEST(SolidOutline, FrustaAnywhere) {
  constexpr std::uint64_t kSeed = 20260103;
  Random random(kSeed);
  Comparison comparison;
  for (int i = 0; i < 600; ++i) {
    Scene scene;
    AddMaterial(scene, 0.5, 0);
    AddBox(scene, Vec3::Constant(-3), Vec3::Constant(3), true, 0);
    for (int k = 0; k < 4; ++k) AddFrustum(scene, random, RandomMotion(random, 2.5));
    FindConvexSolids(scene);
    for (int k = 0; k < 4; ++k) {
      const auto own = static_cast<PatchId>(random.Index(static_cast<std::uint32_t>(scene.patches.size())));
      comparison.Compare(scene, ReceiverOn(scene.patches[static_cast<std::size_t>(own)], random), own);
      ReceiverPoint in_space;
      in_space.position = RandomPoint(random, 2.9);
      in_space.normal = RandomDirection(random);
      comparison.Compare(scene, in_space, kNoPatch);
    }
  }
  comparison.Print("frusta", kSeed);
}

// A floor and shelves in convex and bent pieces, with backs of another partition: nothing is joined that
// bends.
TEST(SolidOutline, PiecesOfPlanes) {
  constexpr std::uint64_t kSeed = 20260105;
  Random random(kSeed);
  Comparison comparison;
  for (int i = 0; i < 200; ++i) {
    Scene scene;
    AddMaterial(scene, 0.5, 0);
    AddBox(scene, Vec3::Constant(-3), Vec3::Constant(3), true, 0);
    for (int k = 0; k < 3; ++k) {
      const Motion motion = RandomMotion(random, 2);
      for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 3; ++y) {
          const auto at = [&](int u, int v) { return motion(0.3 * Vec3(x + u, y + v, 0)); };
          if (random.Index(3) != 0) Add(scene, {at(0, 0), at(1, 0), at(1, 1), at(0, 1)}, 0);
          if (random.Index(3) == 0) Add(scene, {at(0, 0), at(0, 1), at(1, 1), at(1, 0)}, 0);
        }
    }
    FindConvexSolids(scene);
    for (int k = 0; k < 5; ++k) {
      ReceiverPoint at;
      at.position = RandomPoint(random, 2.9);
      at.normal = RandomDirection(random);
      comparison.Compare(scene, at, kNoPatch);
    }
  }
  comparison.Print("pieces of planes", kSeed);
}

// A box before a light is one occluder with six borders at most, from wherever it is seen.
TEST(SolidOutline, OfABoxHasSixBordersAtMost) {
  Random random(20260104);
  Scene scene;
  AddBox(scene, {-1, -1, -1}, {1, 1, 1}, false, AddMaterial(scene, 0.5, 0));
  FindConvexSolids(scene);
  ASSERT_EQ(scene.solids.size(), 1U);
  for (int i = 0; i < 1000; ++i) {
    ReceiverPoint at;
    at.position = random.Uniform(1.8, 10) * RandomDirection(random);
    int fronts = 0;
    for (int axis = 0; axis < 3; ++axis) fronts += std::abs(at.position[axis]) > 1 ? 1 : 0;
    EXPECT_EQ(SeenOutline(at, scene.solids[0], nullptr).seen.size(), fronts == 1 ? 4 : 6);
  }
  ReceiverPoint inside;
  EXPECT_TRUE(SeenOutline(inside, scene.solids[0], nullptr).seen.empty());
}

}  // namespace
}  // namespace penumbra::scene_test
