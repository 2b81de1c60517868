// Scenes that break others: contacts, flush and coplanar lights, slits, blinds, boxes that cut each other,
// faces given twice, slivers. Every exact method gives the same, nothing is NaN, nothing leaks.

#include <gtest/gtest.h>

#include <string>

#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

struct Agreement {
  double worst = 0;
  int points = 0;

  ~Agreement() { std::printf("%d points, largest difference between methods %.2g\n", points, worst); }

  // The irradiance by the default way, after all others gave the same.
  double At(const Scene& scene, const ReceiverPoint& at) {
    static const std::vector<NamedMethod> methods = ExactMethods();
    const double plain = Direct(scene, at).irradiance[0];
    EXPECT_TRUE(std::isfinite(plain)) << at.position.transpose();
    EXPECT_GE(plain, 0) << at.position.transpose();
    for (const auto& [name, method] : methods) {
      const double got = Direct(scene, at, method.get()).irradiance[0];
      EXPECT_NEAR(got, plain, kOcclusionError) << name << " at " << at.position.transpose();
      worst = std::max(worst, std::abs(got - plain));
    }
    ++points;
    return plain;
  }
};

// A room with a square light just under the ceiling, which is larger than it.
Scene RoomWithLight(double light_height) {
  Scene scene;
  const std::int32_t grey = AddMaterial(scene, 0.5, 0), light = AddMaterial(scene, 0, 1);
  AddBox(scene, {0, 0, 0}, {4, 4, 3}, true, grey);
  const double z = light_height;
  Add(scene, {{1.5, 1.5, z}, {1.5, 2.5, z}, {2.5, 2.5, z}, {2.5, 1.5, z}}, light);
  return scene;
}

// All round the foot of a block that stands on an uncut floor, from 0.1 m to 1e-9 m beside it: towards the
// foot the irradiance settles, in steps that the distance bounds, except around the corners, where it depends
// on the angle; under the block it is dark.
TEST(HardScenes, BlockOnUncutFloor) {
  Scene scene = RoomWithLight(2.9);
  AddBox(scene, {1, 1, 0}, {2, 2.25, 1}, false, 0);
  Agreement agreement;
  for (int side = 0; side < 4; ++side)
    for (const double along : {1e-9, 1e-3, 0.25, 0.5, 0.875, 1 - 1e-9}) {
      double last = -1;
      for (const double d : {1e-1, 1e-3, 1e-6, 1e-9}) {
        const auto beside = [&](double distance) {
          return side == 0   ? Vec3(1 - distance, 1 + 1.25 * along, 0)
                 : side == 1 ? Vec3(2 + distance, 1 + 1.25 * along, 0)
                 : side == 2 ? Vec3(1 + along, 1 - distance, 0)
                             : Vec3(1 + along, 2.25 + distance, 0);
        };
        const double got = agreement.At(scene, Receiver(beside(d), Vec3::UnitZ()));
        if (last >= 0 && along > 1e-2 && along < 0.99) {
          EXPECT_NEAR(got, last, d < 1e-2 ? 200 * d : 0.1);
        }
        last = got;
        EXPECT_EQ(agreement.At(scene, Receiver(beside(-d), Vec3::UnitZ())), 0) << "under the block";
      }
    }
}

// A light flush with the ceiling that it lies in: the ceiling, uncut, takes nothing of it, and what stands
// 1e-9 below it sees it as if it filled the sky.
TEST(HardScenes, FlushLight) {
  const Scene flush = RoomWithLight(3);
  Scene alone = flush;
  alone.patches.erase(alone.patches.begin(), alone.patches.end() - 1);
  Agreement agreement;
  Random random(901);
  for (int i = 0; i < 50; ++i) {
    const ReceiverPoint at =
        Receiver({random.Uniform(0.1, 3.9), random.Uniform(0.1, 3.9), random.Uniform(0, 2.9)}, Vec3::UnitZ());
    EXPECT_EQ(agreement.At(flush, at), Direct(alone, at).irradiance[0]);
  }
  EXPECT_NEAR(agreement.At(flush, Receiver({2, 2, 3 - 1e-9}, Vec3::UnitZ())), 1, 1e-9);
  EXPECT_EQ(agreement.At(flush, Receiver({2, 2, 3}, -Vec3::UnitZ())), 0) << "in the light's own plane";
}

// A blocker in the light's plane takes nothing; 1e-9 before it, it takes what it covers.
TEST(HardScenes, CoplanarBlocker) {
  Agreement agreement;
  Scene plain;
  AddMaterial(plain, 0.5, 0);
  const std::int32_t light = AddMaterial(plain, 0, 1);
  Add(plain, {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, light);
  const ReceiverPoint at = Receiver({0.25, 0.125, 0}, Vec3::UnitZ());
  const double open = agreement.At(plain, at);
  for (const double gap : {0.0, 1e-9, 1e-6, 1e-3}) {
    Scene blocked = plain;
    const double z = 2 - gap;
    Add(blocked, {{0, -2, z}, {2, -2, z}, {2, 2, z}, {0, 2, z}}, 0);
    Scene half = plain;
    half.patches.clear();
    Add(half, {{-1, -1, 2}, {-1, 1, 2}, {0, 1, 2}, {0, -1, 2}}, light);
    const double want = gap == 0 ? open : agreement.At(half, at);
    EXPECT_NEAR(agreement.At(blocked, at), want, gap);
  }
}

// Through a slit of width w between two half planes comes w times what a slit of width 1 would let through at
// that place, for small w: two widths compare to their ratio.
TEST(HardScenes, Slit) {
  Agreement agreement;
  const auto through = [&](double width, double turn) {
    Scene scene;
    AddMaterial(scene, 0.5, 0);
    Add(scene, {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, AddMaterial(scene, 0, 1));
    Add(scene, {{-9, -9, 1}, {-0.5 * width, -9, 1}, {-0.5 * width, 9, 1}, {-9, 9, 1}}, 0);
    Add(scene, {{0.5 * width, -9, 1}, {9, -9, 1}, {9, 9, 1}, {0.5 * width, 9, 1}}, 0);
    Motion motion;
    motion.turn = Eigen::AngleAxisd(turn, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    return agreement.At(Mapped(scene, motion), Receiver(Vec3::Zero(), motion.turn * Vec3::UnitZ()));
  };
  for (const double turn : {0.0, 0.7}) {
    const double thousandth = through(1e-3, turn);
    EXPECT_NEAR(through(1e-6, turn) / thousandth, 1e-3, 1e-8) << turn;
    EXPECT_NEAR(through(1e-9, turn) / thousandth, 1e-6, turn == 0 ? 1e-11 : 1e-9) << turn;
    EXPECT_EQ(through(0, turn), 0) << turn;
  }
}

// A blind of 64 slats, closed but for overlaps of nothing, half open, and edge on.
TEST(HardScenes, Blind) {
  Agreement agreement;
  const auto blind = [&](double tilt, double width) {
    Scene scene;
    AddMaterial(scene, 0.5, 0);
    Add(scene, {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, AddMaterial(scene, 0, 1));
    for (int i = 0; i < 64; ++i) {
      const double x = -2 + (i + 0.5) / 16, dx = 0.5 * width / 16 * std::cos(tilt),
                   dz = 0.5 * width / 16 * std::sin(tilt);
      Add(scene, {{x - dx, -2, 1 - dz}, {x + dx, -2, 1 + dz}, {x + dx, 2, 1 + dz}, {x - dx, 2, 1 - dz}}, 0);
    }
    return scene;
  };
  const ReceiverPoint at = Receiver({0.1, 0.2, 0}, Vec3::UnitZ());
  Scene open = blind(0, 1);
  open.patches.resize(1);
  const double whole = agreement.At(open, at);
  EXPECT_EQ(agreement.At(blind(0, 1), at), 0);
  EXPECT_NEAR(agreement.At(blind(0, 0.5), at), 0.5 * whole, 0.02 * whole);
  EXPECT_GT(agreement.At(blind(std::numbers::pi / 2, 1), at), 0.7 * whole);
  for (const double tilt : {0.3, 0.7, 1.2, -0.4}) {
    const double got = agreement.At(blind(tilt, 1), at);
    EXPECT_GE(got, 0);
    EXPECT_LE(got, whole);
  }
}

// Boxes that cut through each other, on and off the grid: as many faces as there are, all methods agree, and
// where the boxes form one solid, its inside is dark.
TEST(HardScenes, InterpenetratingBoxes) {
  Random random(902);
  Agreement agreement;
  for (int i = 0; i < 20; ++i) {
    Scene scene = RoomWithLight(2.9);
    const bool grid = i % 2 == 0;
    const auto coordinate = [&](double low, double high) {
      return grid ? low + 0.25 * random.Index(static_cast<std::uint32_t>(4 * (high - low)) + 1)
                  : random.Uniform(low, high);
    };
    for (int box = 0; box < 6; ++box) {
      const Vec3 low(coordinate(0.5, 2), coordinate(0.5, 2), coordinate(0, 1));
      AddBox(scene, low, low + Vec3(coordinate(0.5, 1.5), coordinate(0.5, 1.5), coordinate(0.25, 1)), false,
             0);
    }
    for (int k = 0; k < 10; ++k)
      agreement.At(scene, Receiver({random.Uniform(0.1, 3.9), random.Uniform(0.1, 3.9), k % 2 == 0 ? 0 : 0.5},
                                   Vec3::UnitZ()));
  }
}

// Every face twice, and all of them reversed as well: nothing changes.
TEST(HardScenes, DuplicatedFaces) {
  Random random(903);
  Agreement agreement;
  for (int i = 0; i < 20; ++i) {
    const Scene scene = FurnishedRoom(random, 5);
    Scene twice = scene;
    for (const Patch& patch : scene.patches) {
      if (scene.materials[static_cast<std::size_t>(patch.material)].emittance[0] > 0) continue;
      Polygon3 reversed(patch.Vertices().begin(), patch.Vertices().end());
      std::reverse(reversed.begin(), reversed.end());
      Add(twice, reversed, 0);
      twice.patches.push_back(patch);
    }
    for (int k = 0; k < 5; ++k) {
      const ReceiverPoint at = Receiver({random.Uniform(0, 4), random.Uniform(0, 4), 0}, Vec3::UnitZ());
      EXPECT_NEAR(agreement.At(twice, at), Direct(scene, at).irradiance[0], 1e-13);
    }
  }
}

// A thousand slivers fan out under the light: triangles of a width of 1e-6 to 1e-12 of their length that
// share a vertex, and a needle or two that cross them.
TEST(HardScenes, ThousandSlivers) {
  Random random(904);
  Agreement agreement;
  Scene scene;
  AddMaterial(scene, 0.5, 0);
  Add(scene, {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, AddMaterial(scene, 0, 1));
  for (int i = 0; i < 1000; ++i) {
    const double angle = random.Uniform(0, 2 * std::numbers::pi), width = random.LogUniform(1e-12, 1e-6);
    const Vec3 tip(std::cos(angle), std::sin(angle), 1 + random.Uniform(-0.3, 0.3)),
        side(-std::sin(angle), std::cos(angle), 0);
    Add(scene, {Vec3(0, 0, 1), tip - width * side, tip + width * side}, 0);
  }
  Scene open = scene;
  open.patches.resize(1);
  for (int k = 0; k < 2; ++k) {
    const ReceiverPoint at =
        Receiver({random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5), 0}, Vec3::UnitZ());
    const double whole = Direct(open, at).irradiance[0], got = Direct(scene, at).irradiance[0];
    EXPECT_TRUE(std::isfinite(got));
    EXPECT_LE(got, whole);
    // Each takes at most its width times the light's brightest strip.
    EXPECT_GE(got, whole - 1000 * 1e-6);
  }
  // The exact methods take minutes for a thousand: a hundred of them.
  scene.patches.resize(101);
  agreement.At(scene, Receiver({0.1, 0.2, 0}, Vec3::UnitZ()));
  // Seen from a vertex's own line of sight and from the plane of many.
  agreement.At(scene, Receiver({0, 0, 0}, Vec3::UnitZ()));
  agreement.At(scene, Receiver({0, 0, 1}, Vec3::UnitZ()));
}

}  // namespace
}  // namespace penumbra::scene_test
