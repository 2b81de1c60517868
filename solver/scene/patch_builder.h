// solver/scene/patch_builder.h
//
// Builds the patches of a scene from its faces: convex planar triangles and quadrilaterals. No two patches of
// the same orientation overlap in one plane.

#pragma once

#include <cstdint>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

struct PatchReport {
  std::vector<std::int32_t> cut_faces;  // sorted: faces that lost an overlap to an emitter or an earlier face
  double largest_distance = 0;          // largest distance between planes that count as one [m]
  std::vector<std::int32_t> narrow_faces;  // sorted: too narrow to be a patch
};

// Fills scene.patches from scene.faces, sorted by their first face, and finds the solids among them:
//
//  (1) Convex triangles and quadrilaterals remain unchanged, except that straight corners are removed. Faces
//      that are not planar are cut into triangles: FlatPieces().
//  (2) Coplanar triangles with a common edge and the same objects and material are joined if they form a
//      convex quadrilateral, the best shaped first.
//  (3) Where outlines of the same orientation overlap in one plane, the emitter has precedence, otherwise the
//      first; the other outlines lose the overlap. Outlines of opposite orientation, such as the bottom of a
//      box and the floor, remain. Planes and edges that differ by no more than the rounding of coordinates
//      (Scene::coordinate_step) count as one.
//  (4) Polygons that are still not convex triangles or quadrilaterals are triangulated, and the triangles are
//      joined to few convex pieces.
//
// Patches narrower than a few times SnapDistance() are dropped.
//
// Vertices of patches equal those of faces to the bit, except where the cutting face lies slightly off the
// plane of the cut face. A crossing of outlines is rounded once for all pieces of a face.
PatchReport BuildPatches(Scene& scene);

}  // namespace penumbra
