// mesh/triangulation/leaf_triangulation.h
//
// The triangles of a patch: every leaf of the quadtree is triangulated along its active discontinuities
// (thesis 5.2, 5.5). The interior of the patch has no T-vertex (3.6, cases A and B).
//
// Neighbouring leaves have the same vertices on their common border, because PatchBorders computes these
// vertices once per patch. Vertices inside a leaf do not affect other leaves, and keep a distance from the
// border (leaf_margins.h).

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
    std::array<std::uint32_t, 3> vertex;  // counter-clockwise as seen from the front
    // Edge k runs from vertex k to vertex k + 1.
    std::array<std::int32_t, 3> line = {kNoLine, kNoLine, kNoLine};  // index in PatchDSets::lines
    std::array<bool, 3> contact = {false, false, false};  // edge k is a contact: the irradiance jumps (D0)
  };

  PatchId patch = kNoPatch;
  std::vector<Vec3> positions;                // [m]
  std::vector<Vec2> in_plane;                 // the same in the patch's frame [m]
  std::vector<Triangle> triangles;            // leaf by leaf, depth first
  std::vector<ElementId> leaves;              // depth first
  std::vector<std::uint32_t> first_triangle;  // per leaf, and past the last
  std::size_t dropped_segments = 0;  // omitted discontinuity edges, within rounding of a leaf's border
  std::size_t leaves_made = 0;       // leaves with lines that were triangulated
  std::size_t leaves_kept = 0;       // leaves with lines whose triangles were in the cache

  // Stops the program unless every triangle is counter-clockwise, the areas add up to the patch's area, and
  // the mesh conforms: each edge has one triangle on either side, or lies on the patch's outline.
  void Validate(const Patch& outline) const;
};

// Triangulates the leaves of dsets.leaves, in parallel. The same input gives the same bytes, with or without
// a cache. REQUIRES: the quadtree is balanced, and has not changed since `dsets` were computed.
PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets);
// Like TriangulateLeaves() above, with given borders: `borders` was constructed from the same arguments, and
// may have been welded to the borders of other patches. Leaves of this patch that are in the cache are reused
// if their borders and lines are equal; afterwards, the cache contains exactly the present leaves with lines.
PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets,
                                     PatchBorders borders, LeafMeshCache* cache = nullptr);

}  // namespace penumbra
