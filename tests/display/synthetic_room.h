// tests/display/synthetic_room.h
//
// Scenes with a mesh whose every irradiance is known, for tests and benchmarks of the display. The synthetic
// scene is an axis-aligned room with boxes in it, seen from inside. Each side of the room and of a box is a
// patch that is cut into cells x cells quadrilaterals, whose inner vertices are moved at random.

#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/base/random.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct SyntheticScene {
  Scene scene;
  IrradianceMesh mesh;
};

using IrradianceField = std::function<Rgb(const Vec3& position, const Vec3& normal)>;

// Adds a triangle on the patch `patch` whose interpolant has the values of `field` at the triangle's six
// sample points.
inline void AddMeshTriangle(const std::array<std::uint32_t, 3>& vertex, PatchId patch,
                            const IrradianceField& field, SyntheticScene* out) {
  IrradianceMesh& mesh = out->mesh;
  const Vec3& normal = out->scene.patches[static_cast<std::size_t>(patch)].normal;
  const Vec3 &x = mesh.positions[vertex[0]], &y = mesh.positions[vertex[1]], &z = mesh.positions[vertex[2]];
  std::array<Rgb, 6> samples;
  for (std::size_t n = 0; n < 6; ++n)
    samples[n] = field(x + kSampleAt[n][0] * (y - x) + kSampleAt[n][1] * (z - x), normal);
  mesh.triangles.push_back({vertex, patch, {}});
  mesh.irradiance.push_back(QuadraticInterpolant::Quadratic(samples));
}

// The material, mesh and irradiance of a surface.
struct SyntheticSurface {
  int material = 0;
  int cells = 1;     // number of quadrilaterals (of two triangles each) along each side
  double shake = 0;  // inner vertices move by at most this fraction of a cell, below 1/2
  IrradianceField field;
};

// Adds the parallelogram with corner p and sides u and v as a patch of triangles. The front of the
// parallelogram faces the direction u x v.
inline void AddParallelogram(const Vec3& p, const Vec3& u, const Vec3& v, const SyntheticSurface& surface,
                             Random* random, SyntheticScene* out) {
  const int cells = surface.cells;
  const std::array<Vec3, 4> corners = {p, p + u, p + u + v, p + v};
  const auto patch = static_cast<PatchId>(out->scene.patches.size());
  out->scene.patches.push_back(MakePatch(corners, surface.material, 0, {patch}));
  const auto base = static_cast<std::uint32_t>(out->mesh.positions.size());
  const auto inner = [&surface](int i) { return i > 0 && i < surface.cells; };
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double a = (i + (inner(i) ? surface.shake * random->Uniform(-1, 1) : 0)) / cells;
      const double b = (j + (inner(j) ? surface.shake * random->Uniform(-1, 1) : 0)) / cells;
      out->mesh.positions.push_back(p + a * u + b * v);
    }
  const auto add = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    AddMeshTriangle({i, j, k}, patch, surface.field, out);
  };
  const auto stride = static_cast<std::uint32_t>(cells) + 1;
  for (std::uint32_t j = 0; j + 1 < stride; ++j)
    for (std::uint32_t i = 0; i + 1 < stride; ++i) {
      const std::uint32_t at = base + j * stride + i;
      if (random->Index(2) == 0) {
        add(at, at + 1, at + stride + 1);
        add(at, at + stride + 1, at + stride);
      } else {
        add(at, at + 1, at + stride);
        add(at + 1, at + stride + 1, at + stride);
      }
    }
}

// Adds the six sides of an axis-aligned box, with fronts facing outward or inward.
inline void AddBox(const Vec3& low, const Vec3& high, bool inward, const SyntheticSurface& surface,
                   Random* random, SyntheticScene* out) {
  const Vec3 size = high - low;
  const Vec3 x = size.x() * Vec3::UnitX(), y = size.y() * Vec3::UnitY(), z = size.z() * Vec3::UnitZ();
  const auto side = [&](const Vec3& p, const Vec3& u, const Vec3& v) {
    if (inward)
      AddParallelogram(p, v, u, surface, random, out);
    else
      AddParallelogram(p, u, v, surface, random, out);
  };
  side(low, y, x);
  side(low, x, z);
  side(low, z, y);
  side(low + z, x, y);
  side(low + y, z, x);
  side(low + x, y, z);
}

// Returns the irradiance of a smooth field, which is quadratic in the position on each plane [W/m^2].
inline Rgb QuadraticField(const Vec3& p, const Vec3& normal) {
  const double light = 20 + 4 * p.z() * p.z() + 2 * p.x() * (6 - p.x()) + p.y() * (5 - p.y()) +
                       3 * p.x() * p.y() + 5 * normal.dot(Vec3(0.3, 0.5, 0.8));
  return light * Rgb(1, 0.9, 0.75);
}

// Makes a room of 6 x 5 x 3 m with five boxes in it and a light below its ceiling. The mesh of the room has 2
// (36 cells^2 + 1) triangles.
inline SyntheticScene MakeRoom(int cells, double shake = 0.3, std::uint64_t seed = 1) {
  SyntheticScene room;
  room.scene.materials = {{"wall", Rgb(0.7, 0.7, 0.65), Rgb::Zero()},
                          {"wood", Rgb(0.5, 0.3, 0.15), Rgb::Zero()},
                          {"light", Rgb(0.5, 0.5, 0.5), Rgb(300, 280, 250)}};
  Random random(seed);
  const auto box = [&](const Vec3& low, const Vec3& high, bool inward, int material) {
    AddBox(low, high, inward, {material, cells, shake, QuadraticField}, &random, &room);
  };
  box({0, 0, 0}, {6, 5, 3}, true, 0);
  box({1, 3, 0.7}, {3, 4, 0.75}, false, 1);
  box({1.1, 3.1, 0}, {1.2, 3.9, 0.7}, false, 1);
  box({2.8, 3.1, 0}, {2.9, 3.9, 0.7}, false, 1);
  box({4.5, 4.5, 0}, {5.7, 4.9, 2}, false, 1);
  box({4, 1, 0}, {4.5, 1.5, 0.45}, false, 1);
  AddParallelogram({2.5, 2, 2.9}, {0, 1, 0}, {1, 0, 0}, {2, 1, 0, QuadraticField}, &random, &room);
  return room;
}

// A camera whose view of the room contains the boxes, the light and the walls.
inline Camera RoomCamera() { return {"room", {5.6, 0.4, 1.9}, {2, 3.5, 0.8}, Vec3::UnitZ(), 60}; }

}  // namespace penumbra
