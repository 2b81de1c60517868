// solver/scene/patch_builder.h
//
// From the faces of a scene to its patches: convex planar triangles and quadrilaterals, none of which lies on
// another that looks the same way.

#pragma once

#include <cstdint>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

struct PatchReport {
  std::vector<std::int32_t>
      cut_faces;                // ascending: faces that lost what overlaps an emitter or an earlier face
  double largest_distance = 0;  // between planes that count as one [m]
  std::vector<std::int32_t> narrow_faces;  // ascending: too narrow to be a patch
};

// Fills scene.patches from scene.faces, ascending by their first face, and finds the solids among them:
//
//  (1) Convex triangles and quadrilaterals stay as they are. A straight corner is left out. Faces that are
//  not
//      planar are cut into triangles: FlatPieces().
//  (2) Coplanar triangles of the same objects and material with a common edge are joined where they form a
//  convex
//      quadrilateral, the best shaped first.
//  (3) Where outlines that look the same way overlap in one plane, the emitter wins, else the first; the
//      others lose the overlap. Opposite-facing ones, like the foot of a box and the floor, stay. What the
//      digits of coordinates cannot tell apart (Scene::coordinate_step) is one plane, and one edge.
//  (4) What is then not a convex triangle or quadrilateral is triangulated and joined to few pieces.
//
// A patch that is narrower than a few times SnapDistance() is left out.
//
// Vertices of faces keep their bits, but where a face is cut by one a little off its plane; a crossing of
// outlines is rounded once for all pieces of a face.
PatchReport BuildPatches(Scene& scene);

}  // namespace penumbra
