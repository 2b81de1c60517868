// mesh/triangulation/leaf_triangulation.h
//
// The triangles of a patch: every leaf of the patch's quadtree is triangulated along its active
// discontinuities, which become edges of triangles (thesis 5.2, 5.5). The triangulation of a patch has no
// T-vertex inside the patch (thesis 3.6, cases A and B).
//
// Neighbouring quadtree leaves have the same vertices on their common border, because PatchBorders computes
// these vertices once per patch. Vertices inside a quadtree leaf do not affect other leaves, and have a
// minimum distance from the leaf's border (leaf_margins.h).

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/discontinuities/dset.h"
#include "mesh/triangulation/leaf_triangulator.h"
#include "mesh/triangulation/patch_borders.h"
#include "solver/geometry/vec.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

struct PatchTriangulation {
  struct Triangle {
    // Indices of the vertices, counter-clockwise as seen from the patch's front.
    std::array<std::uint32_t, 3> vertex;
    // Edge k of a triangle runs from vertex k to vertex (k + 1) % 3. For each edge of the triangle, the index
    // in PatchDSets::lines of the discontinuity line along the edge, or kNoLine.
    std::array<std::int32_t, 3> line = {kNoLine, kNoLine, kNoLine};
    // True if another surface touches the patch along edge k, where the irradiance jumps (D0).
    std::array<bool, 3> contact = {false, false, false};
  };

  PatchId patch = kNoPatch;
  std::vector<Vec3> positions;      // positions of the vertices in space [m]
  std::vector<Vec2> in_plane;       // positions of the vertices in the patch's frame [m]
  std::vector<Triangle> triangles;  // triangles of all quadtree leaves, in the order of `leaves`
  std::vector<ElementId> leaves;    // quadtree leaves of the patch, in depth-first order
  // For each quadtree leaf, the index of its first triangle in `triangles`; the last entry is the number of
  // all triangles.
  std::vector<std::uint32_t> first_triangle;
  // The number of discontinuity edges omitted because their distance from the border of a quadtree leaf is
  // within rounding.
  std::size_t dropped_segments = 0;
  // Number of quadtree leaves with discontinuity lines that were triangulated anew.
  std::size_t leaves_made = 0;
  // The number of quadtree leaves with discontinuity lines whose triangles came from the cache.
  std::size_t leaves_kept = 0;

  // Stops the program unless every triangle is counter-clockwise, the areas of the triangles add up to the
  // patch's area, and the mesh conforms. In a conforming mesh, each edge has one triangle on either side, or
  // lies on the patch's outline.
  void Validate(const Patch& outline) const;
};

// Triangulates the quadtree leaves in dsets.leaves, in parallel. The same input gives the same triangulation
// to the byte, with or without a cache. REQUIRES: the quadtree is balanced, and has not changed since `dsets`
// were computed.
PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets);
// Triangulates the quadtree leaves in dsets.leaves, with given vertices on the borders of the leaves.
// `borders` was constructed from `forest`, `patch` and `dsets`, and may already share vertices with the
// borders of other patches (WeldOutlines). The cached triangles of a leaf are reused if the leaf's border and
// its discontinuity lines are unchanged. After TriangulateLeaves(), the cache contains exactly the present
// leaves that have discontinuity lines.
PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets,
                                     PatchBorders borders, LeafMeshCache* cache = nullptr);

}  // namespace penumbra
