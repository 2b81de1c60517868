// tests/mesh/mesh_test_scenes.h
//
// Small scenes and random quadtrees for the tests of the mesh.

#pragma once

#include <cmath>
#include <initializer_list>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/discontinuities/dset.h"
#include "solver/base/random.h"
#include "solver/scene/convex_solids.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra::mesh_test {

// A point as a key for sorted containers, in which 0 and -0 are equal.
using Place = std::tuple<double, double, double>;
inline Place PlaceOf(const Vec3& p) { return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; }

inline PatchId AddPatch(Scene& scene, std::initializer_list<Vec3> vertices, std::int32_t material = 0) {
  const std::vector<Vec3> list(vertices);
  scene.patches.push_back(MakePatch(list, material, 0, {static_cast<std::int32_t>(scene.patches.size())}));
  return static_cast<PatchId>(scene.patches.size()) - 1;
}

inline Scene EmptyScene() {
  Scene scene;
  scene.materials = {Material{"grey", Rgb::Constant(0.5), Rgb::Zero()},
                     Material{"light", Rgb::Constant(0.0), Rgb::Constant(1.0)}};
  scene.objects = {Object{"all", {}}};
  return scene;
}

// Adds a horizontal square; its front faces upwards if `up` is true, and downwards otherwise.
inline PatchId AddSquare(Scene& scene, const Vec3& centre, double half, bool up, std::int32_t material = 0) {
  const double x = centre.x(), y = centre.y(), z = centre.z();
  const Vec3 a(x - half, y - half, z), b(x + half, y - half, z), c(x + half, y + half, z),
      d(x - half, y + half, z);
  return up ? AddPatch(scene, {a, b, c, d}, material) : AddPatch(scene, {a, d, c, b}, material);
}

// Adds the six faces of a box, or five without the bottom, with fronts facing outward. Returns the first
// patch of the box.
inline PatchId AddBox(Scene& scene, const Vec3& low, const Vec3& high, bool bottom) {
  const auto at = [&](int i, int j, int k) {
    return Vec3(i ? high.x() : low.x(), j ? high.y() : low.y(), k ? high.z() : low.z());
  };
  const PatchId first = AddPatch(scene, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
  AddPatch(scene, {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)});
  AddPatch(scene, {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)});
  AddPatch(scene, {at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1)});
  AddPatch(scene, {at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1)});
  if (bottom) AddPatch(scene, {at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)});
  return first;
}

// Makes a scene with a rotated square light above a floor, `aside` metres off the middle, and three boards
// between light and floor. The three boards lie at three heights, and no two of their inner edges lie in one
// plane. The inner edges of the three boards enclose a triangular hole in the middle.
inline Scene ThreeBoards(double half, double aside = 0) {
  Scene scene = EmptyScene();
  AddSquare(scene, {0, 0, 0}, 4, true);
  AddPatch(scene,
           {{aside + half, 0.1 * half, 4},
            {aside + 0.1 * half, -half, 4},
            {aside - half, -0.1 * half, 4},
            {aside - 0.1 * half, half, 4}},
           1);
  constexpr double kLength = 0.9, kWidth = 1.5, kRise = 0.1;
  for (int i = 0; i < 3; ++i) {
    const double angle = 0.3 + i * 2 * M_PI / 3;
    const Vec3 out(std::cos(angle), std::sin(angle), 0), along(-out.y(), out.x(), kRise);
    const Vec3 inner = 0.05 * out + (1.4 + 0.4 * i) * Vec3::UnitZ();
    AddPatch(scene, {inner - kLength * along, inner + kLength * along, inner + kLength * along + kWidth * out,
                     inner - kLength * along + kWidth * out});
  }
  return scene;
}

// Rotates all patches by `degrees` about the x axis and then about the z axis, so that no edge is
// axis-aligned any more.
inline void Tilt(Scene& scene, double degrees) {
  const double angle = degrees * M_PI / 180;
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(angle, Vec3::UnitZ()) * Eigen::AngleAxisd(angle, Vec3::UnitX())).toRotationMatrix();
  for (Patch& patch : scene.patches) {
    std::vector<Vec3> vertices;
    for (const Vec3& v : patch.Vertices()) vertices.push_back(turn * v);
    patch = MakePatch(vertices, patch.material, patch.object, patch.faces);
  }
  FindConvexSolids(scene);
}

// Rounds all coordinates to `decimals` decimals, as a text file does.
inline void RoundCoordinates(Scene& scene, int decimals) {
  const double unit = std::pow(10.0, -decimals);
  for (Patch& patch : scene.patches) {
    std::vector<Vec3> vertices;
    for (const Vec3& v : patch.Vertices()) vertices.push_back((v / unit).array().round().matrix() * unit);
    patch = MakePatch(vertices, patch.material, patch.object, patch.faces);
  }
  FindConvexSolids(scene);
}

// Splits random leaves of the patch's quadtree, `splits` times at most, and then balances the quadtree.
inline void RefineAtRandom(ElementForest& forest, PatchId patch, Random& random, int splits, int max_level) {
  for (int i = 0; i < splits; ++i) {
    ElementId id = ElementForest::Root(patch);
    while (!forest[id].IsLeaf()) id = forest[id].first_child + static_cast<ElementId>(random.Index(4));
    if (forest[id].level < max_level) forest.Subdivide(id);
  }
  forest.Balance(patch);
}

// Makes an artificial discontinuity on the patch, between two points of the patch's plane.
inline Discontinuity Segment(const Vec2& a, const Vec2& b, double weight,
                             DiscontinuityDegree degree = DiscontinuityDegree::kD2) {
  Discontinuity d;
  d.end = {a, b};
  d.receiver = 0;
  d.weight = weight;
  d.degree = degree;
  d.kind = degree == DiscontinuityDegree::kD0 ? DiscontinuityKind::kContact : DiscontinuityKind::kVE;
  return d;
}

}  // namespace penumbra::mesh_test
