// experiments/bench/bench_scenes.h
//
// Scenes that several benchmarks and studies use.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "solver/base/random.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/occlusion_method.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {

inline PatchId AddPatch(Scene& scene, const Polygon3& vertices, std::int32_t material) {
  scene.patches.push_back(
      MakePatch(vertices, material, 0, {static_cast<std::int32_t>(scene.patches.size())}));
  return static_cast<PatchId>(scene.patches.size()) - 1;
}

inline std::vector<Material> GreyAndLight() {
  std::vector<Material> materials(2);
  materials[1].emittance = Rgb::Ones();
  return materials;
}

inline void AddBox(Scene& scene, const Vec3& low, const Vec3& high, bool inwards) {
  const auto at = [&](int i) {
    return Vec3(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  };
  constexpr std::array<std::array<int, 4>, 6> kFaces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const std::array<int, 4>& face : kFaces) {
    Polygon3 polygon;
    for (const int i : face) polygon.push_back(at(i));
    if (inwards) std::reverse(polygon.begin(), polygon.end());
    AddPatch(scene, polygon, 0);
  }
}

// Makes n by n closed rooms side by side, each with two lights and ten boxes. From inside a room, all other
// rooms are hidden.
inline Scene Rooms(int n) {
  Scene scene;
  scene.materials = GreyAndLight();
  Random random(4);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 o(4.2 * i, 4.2 * j, 0);
      AddBox(scene, o, o + Vec3(4, 4, 3), true);
      for (const double x : {1.0, 2.5})
        AddPatch(
            scene,
            {o + Vec3(x, 1, 2.9), o + Vec3(x, 3, 2.9), o + Vec3(x + 0.5, 3, 2.9), o + Vec3(x + 0.5, 1, 2.9)},
            1);
      for (int k = 0; k < 10; ++k) {
        const Vec3 low(random.Uniform(0, 3), random.Uniform(0, 3), random.Uniform(0, 1));
        AddBox(scene, o + low,
               o + low + Vec3(random.Uniform(0.1, 0.8), random.Uniform(0.1, 0.8), random.Uniform(0.1, 1)),
               false);
      }
    }
  return scene;
}

// Makes a scene with a square light of side 1 at height 4 above the origin, and `n` boards between light and
// origin. Each board hides less than the whole light, and all boards together hide about half of the light
// from the origin.
inline Scene LightAndBoards(int n) {
  Scene scene;
  scene.materials = GreyAndLight();
  AddPatch(scene, {{-0.5, -0.5, 4}, {-0.5, 0.5, 4}, {0.5, 0.5, 4}, {0.5, -0.5, 4}}, 1);
  Random random(3);
  const double size = 0.55 / std::sqrt(n);
  for (int i = 0; i < n; ++i) {
    const double z = random.Uniform(0.5, 3.5), scale = z / 4, angle = random.Uniform(0, std::numbers::pi);
    const Vec3 centre(scale * random.Uniform(-0.5, 0.5), scale * random.Uniform(-0.5, 0.5), z);
    const Vec3 u = scale * size * Vec3(std::cos(angle), std::sin(angle), 0.3),
               v = scale * size * Vec3(-std::sin(angle), std::cos(angle), -0.2);
    AddPatch(scene, {centre - u - v, centre + u - v, centre + u + v, centre - u + v}, 0);
  }
  return scene;
}

// Returns the form factor of a point to the part of patch 0 that the given blockers leave visible.
inline double VisibleFactor(const Scene& scene, std::span<const PatchId> blockers, const ReceiverPoint& at,
                            const OcclusionMethod& method) {
  PointView view(scene, at, method);
  view.FaceSource(0);
  const DirectionPolygon seen = view.SeeSource(scene.patches[0].Vertices());
  std::vector<Occluder>& occluders = view.occluder_stack();
  return view.FindBlockers(blockers, kNoPatch, seen, occluders) ? view.VisibleFormFactor(seen, occluders) : 0;
}

}  // namespace penumbra
