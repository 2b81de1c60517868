// Patches are cut along the walls that stand on them, and nowhere else.

#include "solver/scene/contact_cuts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/random.h"
#include "solver/scene/convex_solids.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

constexpr double kRounding = 1e-12;  // of a room of some metres, with the crossings of some cuts

Scene Cut(Scene scene) {
  FindConvexSolids(scene);
  CutAtWalls(scene);
  return scene;
}

void AddGrey(Scene& scene, const Polygon3& polygon) {
  scene.patches.push_back(MakePatch(polygon, 0, 0, {0}));
}

// A floor of 8 m by 4 m, the first patch.
Scene Floor() {
  Scene scene;
  AddMaterial(scene, 0.5, 0);
  AddGrey(scene, {{0, 0, 0}, {8, 0, 0}, {8, 4, 0}, {0, 4, 0}});
  return scene;
}

// The pieces that lie where the floor lay.
std::vector<Patch> PiecesOfFloor(const Scene& scene) {
  std::vector<Patch> pieces;
  for (const Patch& patch : scene.patches) {
    bool flat = true;
    for (const Vec3& v : patch.Vertices()) flat = flat && v.z() == 0;
    if (flat) pieces.push_back(patch);
  }
  return pieces;
}

// No patch has corners on both sides of a wall from end to end, with a doorway or without, thick or thin, on
// the floor or a centimetre above it.
TEST(CutAtWalls, NoPieceReachesUnderAWall) {
  for (const double doorway : {0.0, 0.005, 0.9, 1.5})
    for (const double above : {0.0, 0.01}) {
      Scene scene = Floor();
      AddGrey(scene, {{5, 0, above}, {5, 4 - doorway, above}, {5, 4 - doorway, 2}, {5, 0, 2}});
      scene = Cut(scene);
      EXPECT_EQ(PiecesOfFloor(scene).size(), 2U) << doorway << " m, " << above << " m above";
      double area = 0;
      for (const Patch& piece : PiecesOfFloor(scene)) {
        area += piece.area;
        bool left = false, right = false;
        for (const Vec3& v : piece.Vertices()) {
          left = left || v.x() < 5;
          right = right || v.x() > 5;
        }
        EXPECT_FALSE(left && right);
      }
      EXPECT_NEAR(area, 32, kRounding);
    }
}

// What stands free on the floor is furniture: a box, a screen, a wall with nearly as much doorway as wall. So
// is what hangs higher.
TEST(CutAtWalls, LeavesFurnitureAlone) {
  Scene box = Floor();
  AddBox(box, {2, 1, 0}, {3, 2, 1}, false, 0);
  EXPECT_EQ(PiecesOfFloor(Cut(box)).size(), 2U);  // the floor, and the bottom of the box
  Scene screen = Floor();
  AddGrey(screen, {{5, 1, 0}, {5, 2.5, 0}, {5, 2.5, 2}, {5, 1, 2}});
  EXPECT_EQ(PiecesOfFloor(Cut(screen)).size(), 1U);
  Scene doorway = Floor();
  AddGrey(doorway, {{5, 0, 0}, {5, 2.2, 0}, {5, 2.2, 2}, {5, 0, 2}});
  EXPECT_EQ(PiecesOfFloor(Cut(doorway)).size(), 1U);
  Scene lintel = Floor();
  AddGrey(lintel, {{5, 0, 1}, {5, 4, 1}, {5, 4, 2}, {5, 0, 2}});
  EXPECT_EQ(PiecesOfFloor(Cut(lintel)).size(), 1U);
}

// A box that reaches from wall to wall is a wall. A sheet that lies flat on the floor, looking down, is none.
TEST(CutAtWalls, BoxesFromWallToWall) {
  Scene scene = Floor();
  AddBox(scene, {4, 0, 0}, {4.25, 4, 2}, false, 0);
  const Scene cut = Cut(scene);
  EXPECT_EQ(PiecesOfFloor(cut).size(), 4U);  // the bottom of the box, and what is left, below and right of it
  EXPECT_EQ(cut.solid_of.size(), cut.patches.size());
  Scene sheet = Floor();
  AddGrey(sheet, {{3, 0, 0}, {3, 4, 0}, {5, 4, 0}, {5, 0, 0}});
  EXPECT_EQ(PiecesOfFloor(Cut(sheet)).size(), 2U);
}

// Closets of any number of walls, turned at random with the whole scene: areas add up, and no piece lies on
// both sides of a closet's wall.
TEST(CutAtWalls, Closets) {
  constexpr std::uint64_t kSeed = 20261130;
  Random random(kSeed);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const int walls = 3 + static_cast<int>(random.Uniform() * 14);
    const double radius = 0.4 + random.Uniform(), turn = 2 * std::numbers::pi * random.Uniform();
    const Vec3 centre(2 + 4 * random.Uniform(), 2, 0);
    Scene scene = Floor();
    const auto corner = [&](int k, double z) {
      const double angle = turn + 2 * std::numbers::pi * (k % walls) / walls;
      return Vec3(centre + Vec3(radius * std::cos(angle), radius * std::sin(angle), z));
    };
    for (int k = 0; k < walls; ++k)
      AddGrey(scene, {corner(k, 0), corner(k, 2), corner(k + 1, 2), corner(k + 1, 0)});
    const Motion motion = RandomMotion(random, 10);
    const Scene moved = Mapped(scene, motion);
    const Scene cut = Cut(moved);
    double inside = 0, area = 0;
    for (const Patch& piece : cut.patches) {
      if (piece.normal.dot(moved.patches[0].normal) < 1 - 1e-9) continue;
      area += piece.area;
      int within = 0;
      for (int k = 0; k < walls; ++k) {
        const Patch& wall = moved.patches[static_cast<std::size_t>(k + 1)];
        double low = 0, high = 0;
        for (const Vec3& v : piece.Vertices()) {
          low = std::min(low, wall.normal.dot(v - wall.vertex[0]));
          high = std::max(high, wall.normal.dot(v - wall.vertex[0]));
        }
        if (low > -1e-9) ++within;
      }
      if (within == walls) inside += piece.area;
    }
    const double closet = 0.5 * walls * radius * radius * std::sin(2 * std::numbers::pi / walls);
    worst = std::max({worst, std::abs(area - 32) / 32, std::abs(inside - closet) / closet});
  }
  std::printf("seed %llu: areas within %.2g\n", static_cast<unsigned long long>(kSeed), worst);
  EXPECT_LE(worst, 1e-8);
}

// A sealed room with thick walls: boxes along the sides of a convex polygon, longer than the sides, so that
// their ends cross.
struct ThickRoom {
  std::vector<Vec3> corner;  // of the room's floor, counter-clockwise
  double thickness = 0, overlap = 0;

  ThickRoom(Random& random, const Vec3& centre) {
    const int walls = 3 + static_cast<int>(random.Uniform() * 4);
    const double radius = 0.7 + 0.4 * random.Uniform(), turn = 2 * std::numbers::pi * random.Uniform();
    thickness = 0.05 + 0.15 * random.Uniform();
    overlap = thickness * (0.3 + random.Uniform());
    for (int k = 0; k < walls; ++k) {
      const double angle = turn + 2 * std::numbers::pi * (k + 0.5 * random.Uniform()) / walls;
      corner.emplace_back(centre + radius * Vec3(std::cos(angle), std::sin(angle), 0));
    }
  }
  const Vec3& Corner(std::size_t k) const { return corner[k % corner.size()]; }
  Vec3 Along(std::size_t k) const { return (Corner(k + 1) - Corner(k)).normalized(); }
  Vec3 Outwards(std::size_t k) const { return Along(k).cross(Vec3::UnitZ()); }
  double Area() const {
    Vec3 twice = Vec3::Zero();
    for (std::size_t k = 0; k < corner.size(); ++k) twice += Corner(k).cross(Corner(k + 1));
    return 0.5 * twice.z();
  }
  void AddWalls(Scene& scene) const {
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec3 from = Corner(k) - overlap * Along(k), to = Corner(k + 1) + overlap * Along(k),
                 out = thickness * Outwards(k), up(0, 0, 2);
      const Vec3 foot[4] = {from + out, to + out, to, from};
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 &a = foot[i], &b = foot[(i + 1) % 4];
        AddGrey(scene, {a, b, b + up, a + up});
      }
    }
  }
};

// Thick walls whose ends cross at the corners of a room: the room's floor is made of whole pieces, and no
// piece of a wall's inner side reaches from the room through the next wall to the space outside.
TEST(CutAtWalls, ThickWallsThatCross) {
  constexpr std::uint64_t kSeed = 20261201;
  constexpr double kNear = 1e-9;  // [m]
  Random random(kSeed);
  double worst = 0;
  int through = 0;
  for (int i = 0; i < 100; ++i) {
    const ThickRoom room(random, {2 + 4 * random.Uniform(), 2, 0});
    Scene scene = Floor();
    room.AddWalls(scene);
    const Scene cut = Cut(scene);
    double inside = 0;
    for (const Patch& piece : PiecesOfFloor(cut)) {
      bool within = true;
      for (std::size_t k = 0; k < room.corner.size(); ++k)
        for (const Vec3& v : piece.Vertices())
          within = within && room.Outwards(k).dot(v - room.Corner(k)) < kNear;
      if (within) inside += piece.area;
    }
    worst = std::max(worst, std::abs(inside / room.Area() - 1));
    for (std::size_t k = 0; k < room.corner.size(); ++k) {
      const std::size_t before = k + room.corner.size() - 1;
      for (const Patch& patch : cut.patches) {
        bool in_room = false, outside = false, on_side = true;
        for (const Vec3& v : patch.Vertices()) {
          const Vec3 from_corner = v - room.Corner(k);
          on_side = on_side && std::abs(room.Outwards(k).dot(from_corner)) < kNear;
          in_room = in_room || room.Along(k).dot(from_corner) > kNear;
          outside = outside || room.Outwards(before).dot(from_corner) > room.thickness + kNear;
        }
        if (on_side && in_room && outside) ++through;
      }
    }
  }
  std::printf("seed %llu: areas within %.2g\n", static_cast<unsigned long long>(kSeed), worst);
  EXPECT_LE(worst, 1e-8);
  EXPECT_EQ(through, 0);
}

}  // namespace
}  // namespace penumbra::scene_test
