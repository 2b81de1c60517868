// solver/scene/patch_builder.h
//
// Builds the patches of a scene, which are convex planar triangles and quadrilaterals, from the faces of the
// scene. No two patches of the same orientation overlap in one plane.

#pragma once

#include <cstdint>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

struct PatchReport {
  // sorted indices of faces that lost an overlap to an emitter or an earlier face
  std::vector<std::int32_t> cut_faces;
  // The largest distance between two planes of faces that were taken as one plane [m].
  double largest_distance = 0;
  // The indices of the faces that are too narrow to become a patch, sorted.
  std::vector<std::int32_t> narrow_faces;
};

// Fills scene.patches from scene.faces, and finds the convex solids among the patches. The patches are sorted
// by their first face. BuildPatches() takes the following steps:
//
//  (1) Triangles and convex quadrilaterals remain unchanged, except that straight corners are removed. Faces
//      that are not planar are cut into triangles by FlatPieces().
//  (2) Two coplanar triangles with a common edge, the same objects and the same material are joined if they
//      form a convex quadrilateral; the quadrilaterals of the best shape are formed first.
//  (3) If two outlines (planar polygons) of the same orientation overlap in one plane, the overlap is removed
//      from one of them. The outline of an emitter keeps the overlap; if none or both emit, the first outline
//      keeps the overlap. Overlaps of outlines of opposite orientation, such as the bottom of a box and the
//      floor, remain. Planes and edges whose distance is at most the rounding of coordinates
//      (Scene::coordinate_step) count as equal.
//  (4) Polygons that are not yet triangles or convex quadrilaterals are triangulated, and the triangles are
//      joined to few convex pieces.
//
// Patches whose width is less than a few times SnapDistance() are dropped.
//
// The vertices of patches equal those of faces to the bit, unless a face that cuts another face lies slightly
// off the plane of that face. A crossing of outlines is rounded only once, so that all pieces of a face share
// the same vertex.
PatchReport BuildPatches(Scene& scene);

}  // namespace penumbra
