// solver/scene/scene.h
//
// A scene consists of the faces that the user gave and of the patches that the solver uses. Patches are
// convex planar polygons of three or four vertices (called quadrilaterals in the thesis).
//
// Lengths are in metres, emittance (radiant exitance) is in W/m^2, and reflectance is in [0, 1).

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// The index of a patch in Scene::patches.
using PatchId = std::int32_t;
inline constexpr PatchId kNoPatch = -1;

// The index of a convex solid in Scene::solids.
using SolidId = std::int32_t;
inline constexpr SolidId kNoSolid = -1;

// The largest permitted emittance [W/m^2], so that products of emittances and areas, and sums over faces, do
// not overflow.
inline constexpr double kLargestEmittance = 1e100;

struct Material {
  std::string name;
  Rgb reflectance = Rgb::Constant(0.5);
  Rgb emittance = Rgb::Zero();  // the emittance (radiant exitance) of the material [W/m^2]
};

// A face is a polygon as the user gave it, such as an `f` line of an OBJ file. In output files, the index of
// a face in Scene::faces is called `patch`. A face that is dropped because it has no area keeps its index in
// Scene::faces.
struct Face {
  // The vertices of the face as the user gave them [m]; empty if the face was dropped.
  Polygon3 vertices;
  std::int32_t material = 0;  // index in Scene::materials
  std::int32_t object = 0;    // index in Scene::objects
  // Texture coordinates of the vertices, in the order of the vertices: u to the right and v upwards, with the
  // picture between 0 and 1. Empty if the file gives no texture coordinates for the face.
  std::vector<Vec2> uv = {};
};

// A named group of faces: an OBJ object or group.
struct Object {
  std::string name;
  std::vector<std::int32_t> faces;
};

// A patch is a convex planar polygon of three or four vertices, the root of a quadtree of elements.
struct Patch {
  // Vertices, counter-clockwise seen from the front; vertex[3] is unused in a triangle.
  std::array<Vec3, 4> vertex;
  std::int32_t size = 0;       // the number of vertices of the patch, 3 or 4
  std::int32_t material = 0;   // index in Scene::materials
  std::int32_t object = 0;     // index in Scene::objects
  Vec3 normal = Vec3::Zero();  // unit normal of the front
  double area = 0;             // the area of the front of the patch [m^2]
  // The largest absolute coordinate of the patch [m], to which rounding errors are proportional.
  double extent = 0;
  // The indices of the faces that form the patch: one face, or two that were joined.
  std::vector<std::int32_t> faces;

  std::span<const Vec3> Vertices() const { return {vertex.data(), static_cast<std::size_t>(size)}; }
};

// Makes a patch with the given vertices, and computes its normal, area and extent. REQUIRES: the polygon has
// 3 or 4 vertices, is convex, and has an area > 0.
Patch MakePatch(std::span<const Vec3> vertices, std::int32_t material, std::int32_t object,
                std::vector<std::int32_t> faces);

// A convex solid: patches that are sides of one convex body. Seen from any point outside the body, a single
// outline bounds the region that the body hides.
struct ConvexSolid {
  struct Side {
    // First patch of the side; kNoPatch if the side is missing, as the bottom of a block may be.
    PatchId patch = kNoPatch;
    Vec3 normal = Vec3::Zero();  // the unit normal of the side of the solid, pointing outwards
    // Indices of the side's corners in ConvexSolid::corners, counter-clockwise seen from outside.
    std::vector<std::int32_t> corner;
    // For each corner, the number of the edge from this corner to the next; the two sides at an edge use the
    // same number.
    std::vector<std::int32_t> edge;
  };
  Polygon3 corners;  // the corners of the convex solid [m]
  std::vector<Side> sides;
  double extent = 0;  // the largest absolute coordinate of the solid [m]
};

struct Camera {
  std::string name;
  Vec3 eye = Vec3::Zero();
  Vec3 look_at = Vec3::UnitY();
  Vec3 up = Vec3::UnitZ();
  double vertical_fov = 45;  // the vertical angle of view of the camera, in degrees
};

struct Scene {
  std::string name;
  std::vector<Material> materials;  // the materials of the faces; not empty if the scene has patches
  std::vector<Object> objects;
  std::vector<Face> faces;
  // For each axis, the unit to which the coordinates in the file are rounded [m]; 0 if the coordinates are
  // exact. Planes, edges and corners count as equal if they differ by no more than coordinate_step.
  Vec3 coordinate_step = Vec3::Zero();
  std::vector<Patch> patches;
  std::vector<ConvexSolid> solids;  // the convex solids that FindConvexSolids() has found among the patches
  // solid_of[p] is the index of the solid that patch p belongs to, or kNoSolid.
  std::vector<SolidId> solid_of;
  std::vector<Camera> cameras;  // the cameras of the scene; a scene may have none
  // One line about each repair, each dropped face and each suspected mistake.
  std::vector<std::string> warnings;

  const Material& MaterialOf(PatchId patch) const { return materials[patches[patch].material]; }

  SolidId SolidOf(PatchId patch) const {
    const auto i = static_cast<std::size_t>(patch);
    return i < solid_of.size() ? solid_of[i] : kNoSolid;
  }

  // The index of the face that contains the point p of the given patch; the lowest index if p lies on several
  // faces.
  std::int32_t FaceAt(PatchId patch, const Vec3& p) const;

  // The minimum and maximum corner of the bounding box of all patches; two zero vectors for an empty scene.
  std::pair<Vec3, Vec3> Bounds() const;

  // The length of the diagonal of Bounds() [m].
  double Diagonal() const;
};

}  // namespace penumbra
