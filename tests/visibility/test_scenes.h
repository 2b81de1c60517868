// tests/visibility/test_scenes.h
//
// Small scenes for the tests of visibility and transport: rooms, boxes, lights, random furniture.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/base/random.h"
#include "solver/geometry/polygon.h"
#include "solver/scene/convex_solids.h"
#include "solver/scene/scene.h"

namespace penumbra::scene_test {

inline std::int32_t AddMaterial(Scene& scene, double reflectance, double emittance) {
  Material material;
  material.reflectance = Rgb::Constant(reflectance);
  material.emittance = Rgb::Constant(emittance);
  scene.materials.push_back(material);
  return static_cast<std::int32_t>(scene.materials.size()) - 1;
}

inline PatchId Add(Scene& scene, const Polygon3& polygon, std::int32_t material) {
  scene.patches.push_back(MakePatch(polygon, material, 0, {static_cast<std::int32_t>(scene.patches.size())}));
  return static_cast<PatchId>(scene.patches.size()) - 1;
}

// Adds the six faces of a box in the order bottom, top, sides. The fronts of the box's faces look outwards,
// or inwards if the box is a room.
inline void AddBox(Scene& scene, const Vec3& low, const Vec3& high, bool inwards,
                   const std::array<std::int32_t, 6>& material) {
  const auto at = [&](int i) {
    return Vec3(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  };
  constexpr std::array<std::array<int, 4>, 6> kFaces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (std::size_t f = 0; f < 6; ++f) {
    Polygon3 polygon;
    for (const int i : kFaces[f]) polygon.push_back(at(i));
    if (inwards) std::reverse(polygon.begin(), polygon.end());
    Add(scene, polygon, material[f]);
  }
}

inline void AddBox(Scene& scene, const Vec3& low, const Vec3& high, bool inwards, std::int32_t material) {
  AddBox(scene, low, high, inwards, {material, material, material, material, material, material});
}

inline Vec3 RandomDirection(Random& random) {
  const double z = random.Uniform(-1, 1), angle = random.Uniform(0, 2 * std::numbers::pi),
               r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

inline Vec3 RandomPoint(Random& random, double half) {
  const double x = random.Uniform(-half, half), y = random.Uniform(-half, half);
  return {x, y, random.Uniform(-half, half)};
}

// A rigid motion: a rotation followed by a shift. RandomMotion() takes a random rotation, and a random shift
// in a cube of the given half side.
struct Motion {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 shift = Vec3::Zero();
  Vec3 operator()(const Vec3& p) const { return turn * p + shift; }
};

inline Motion RandomMotion(Random& random, double half) {
  const Vec3 axis = RandomDirection(random);
  Motion motion;
  motion.turn = Eigen::AngleAxisd(random.Uniform(0, 2 * std::numbers::pi), axis).toRotationMatrix();
  motion.shift = RandomPoint(random, half);
  return motion;
}

// Returns the scene with every vertex moved by `map`, and finds the convex solids again. The coordinates of
// the moved vertices are rounded again.
template <class Map>
Scene Mapped(const Scene& scene, const Map& map) {
  Scene moved = scene;
  for (Patch& patch : moved.patches) {
    Polygon3 polygon;
    for (const Vec3& v : patch.Vertices()) polygon.push_back(map(v));
    patch = MakePatch(polygon, patch.material, patch.object, patch.faces);
  }
  FindConvexSolids(moved);
  return moved;
}

// Makes a room [0,4]^3 with a light at or below the ceiling and boxes on or above the floor. All coordinates
// are multiples of 1/4, so that planes, edges and vertices often coincide. Material 0 of the scene is grey,
// and material 1 is the light.
inline Scene FurnishedRoom(Random& random, int boxes) {
  Scene scene;
  const std::int32_t grey = AddMaterial(scene, 0.5, 0), light = AddMaterial(scene, 0, 10);
  AddBox(scene, Vec3::Zero(), Vec3::Constant(4), true, grey);
  const auto grid = [&](double low, double high) {
    return low + 0.25 * random.Index(static_cast<std::uint32_t>((high - low) * 4) + 1);
  };
  for (int i = 0; i < boxes; ++i) {
    const double sx = grid(0.25, 1.5), sy = grid(0.25, 1.5), sz = grid(0.25, 1.5);
    const double x = grid(0, 4 - sx), y = grid(0, 4 - sy), z = random.Index(3) == 0 ? grid(0, 2) : 0;
    AddBox(scene, {x, y, z}, {x + sx, y + sy, z + sz}, false, grey);
  }
  const double x = grid(0, 3), y = grid(0, 3), z = random.Index(2) == 0 ? 3.75 : 3.5;
  Add(scene, {{x, y, z}, {x, y + 1, z}, {x + 1, y + 1, z}, {x + 1, y, z}}, light);
  return scene;
}

// Returns true if the patch cuts the segment from p to q, computed in doubles. In Cuts(), the patch counts as
// larger by `wider` [m] on all sides.
inline bool Cuts(const Patch& patch, const Vec3& p, const Vec3& q, double wider) {
  const double hp = patch.normal.dot(p - patch.vertex[0]), hq = patch.normal.dot(q - patch.vertex[0]);
  if (!(std::min(hp, hq) < -std::abs(wider) && std::max(hp, hq) > std::abs(wider))) return false;
  return ConvexContains(patch.Vertices(), patch.normal, p + (q - p) * (hp / (hp - hq)), wider);
}

}  // namespace penumbra::scene_test
