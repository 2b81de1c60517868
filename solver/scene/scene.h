// solver/scene/scene.h
//
// What a scene is to every later stage: faces as the user gave them, and patches, the convex planar polygons
// of three or four vertices that the solver works on (the thesis's Quadrilaterals).
//
// Units: lengths in metres; emittance (radiant exitance) in W/m^2; reflectance in [0, 1).

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// Index of a patch in Scene::patches.
using PatchId = std::int32_t;
inline constexpr PatchId kNoPatch = -1;

// Index of a solid in Scene::solids.
using SolidId = std::int32_t;
inline constexpr SolidId kNoSolid = -1;

// Products with areas and sums over faces must not overflow [W/m^2].
inline constexpr double kLargestEmittance = 1e100;

struct Material {
  std::string name;
  Rgb reflectance = Rgb::Constant(0.5);
  Rgb emittance = Rgb::Zero();  // [W/m^2]
};

// An `f` line of the file. Its index in Scene::faces is what users see as `patch`; dropped faces keep their
// index.
struct Face {
  Polygon3 vertices;          // as given; empty if the face was dropped
  std::int32_t material = 0;  // index in Scene::materials
  std::int32_t object = 0;    // index in Scene::objects
};

// A named group of faces: an OBJ object or group.
struct Object {
  std::string name;
  std::vector<std::int32_t> faces;
};

// A convex planar polygon of three or four vertices, the root of a quadtree of elements.
struct Patch {
  std::array<Vec3, 4> vertex;       // counter-clockwise from the front; the fourth is unused in a triangle
  std::int32_t size = 0;            // 3 or 4
  std::int32_t material = 0;        // index in Scene::materials
  std::int32_t object = 0;          // index in Scene::objects
  Vec3 normal = Vec3::Zero();       // unit, front
  double area = 0;                  // [m^2]
  double extent = 0;                // the largest absolute coordinate [m]: the scale of rounding
  std::vector<std::int32_t> faces;  // the faces it covers: one, or the two that were merged

  std::span<const Vec3> Vertices() const { return {vertex.data(), static_cast<std::size_t>(size)}; }
};

// A patch from its vertices; normal, area and extent are computed. REQUIRES: 3 or 4 vertices, convex, nonzero
// area.
Patch MakePatch(std::span<const Vec3> vertices, std::int32_t material, std::int32_t object,
                std::vector<std::int32_t> faces);

// Patches that are sides of one convex body: what it hides has a single outline from anywhere outside of it.
struct ConvexSolid {
  struct Side {
    PatchId patch = kNoPatch;  // the first of its pieces; kNoPatch: missing, as the foot of a block often is
    Vec3 normal = Vec3::Zero();        // unit, outwards
    std::vector<std::int32_t> corner;  // in ConvexSolid::corners, counter-clockwise from outside
    std::vector<std::int32_t> edge;    // from each corner to the next: the number is the same for both sides
  };
  Polygon3 corners;  // [m]
  std::vector<Side> sides;
  double extent = 0;  // the largest absolute coordinate [m]
};

struct Camera {
  std::string name;
  Vec3 eye = Vec3::Zero();
  Vec3 look_at = Vec3::UnitY();
  Vec3 up = Vec3::UnitZ();
  double vertical_fov = 45;  // degrees
};

struct Scene {
  std::string name;
  std::vector<Material> materials;  // never empty once patches exist
  std::vector<Object> objects;
  std::vector<Face> faces;
  // Per axis the unit in which coordinates are written: what that cannot tell apart is one plane, one edge or
  // one corner [m]. 0: coordinates are exact.
  Vec3 coordinate_step = Vec3::Zero();
  std::vector<Patch> patches;
  std::vector<ConvexSolid> solids;    // of the patches as they are: FindConvexSolids()
  std::vector<SolidId> solid_of;      // per patch; kNoSolid: of none
  std::vector<Camera> cameras;        // those that the scene brings along; may be empty
  std::vector<std::string> warnings;  // one line each: what was repaired, dropped or looks wrong

  const Material& MaterialOf(PatchId patch) const { return materials[patches[patch].material]; }

  SolidId SolidOf(PatchId patch) const {
    const auto i = static_cast<std::size_t>(patch);
    return i < solid_of.size() ? solid_of[i] : kNoSolid;
  }

  // The face that contains the point p of the patch: the lowest index if p lies on several.
  std::int32_t FaceAt(PatchId patch, const Vec3& p) const;

  // The smallest and largest corner of the box around all patches; two zeros for an empty scene.
  std::pair<Vec3, Vec3> Bounds() const;

  // The length of the diagonal of Bounds() [m].
  double Diagonal() const;
};

}  // namespace penumbra
