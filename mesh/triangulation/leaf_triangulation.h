// mesh/triangulation/leaf_triangulation.h
//
// The triangles of a patch: every leaf of its quadtree, triangulated along its active discontinuities
// (thesis 5.2, 5.5), without a T-vertex inside the patch (3.6, cases A and B).
//
// How neighbouring leaves come to agree: the vertices on their common border are decided once, for the patch
// (PatchBorders). Inside a leaf nothing has to agree with anybody; there it is enough to keep away from the
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
    std::array<std::uint32_t, 3> vertex;  // counter-clockwise from the front
    // Edge k runs from vertex k to vertex k + 1.
    std::array<std::int32_t, 3> line = {kNoLine, kNoLine, kNoLine};  // the PatchDSets::lines that it lies on
    std::array<bool, 3> contact = {false, false, false};             // the irradiance jumps across it (D0)
  };

  PatchId patch = kNoPatch;
  std::vector<Vec3> positions;                // [m]
  std::vector<Vec2> in_plane;                 // the same in the patch's frame [m]
  std::vector<Triangle> triangles;            // leaf by leaf, depth first
  std::vector<ElementId> leaves;              // depth first
  std::vector<std::uint32_t> first_triangle;  // per leaf, and the end
  std::size_t dropped_segments = 0;  // discontinuity edges within rounding of a leaf's border, left out
  std::size_t leaves_made = 0;       // leaves with lines that were triangulated
  std::size_t leaves_kept = 0;       // and those whose triangles were there already

  // Checks that every triangle runs counter-clockwise, that the areas add up to the patch's, and that the
  // mesh conforms: each edge has one triangle on either side, or lies on the patch's outline.
  void Validate(const Patch& outline) const;
};

// Triangulates the leaves of dsets.leaves, in parallel. The same input gives the same bytes, with a cache or
// without. REQUIRES: the quadtree is balanced, and has not changed since `dsets` were made.
PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets);
// The same with borders that were made before from the same arguments, and may have been welded to those of
// other patches. Of the cache, which holds the leaves of this patch, those are used whose borders and lines
// are the same; afterwards it holds the leaves as they are now.
PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets,
                                     PatchBorders borders, LeafMeshCache* cache = nullptr);

}  // namespace penumbra
