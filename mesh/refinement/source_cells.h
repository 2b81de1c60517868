// mesh/refinement/source_cells.h
//
// Finer sources than the solution's leaves, out of the interpolants: each leaf that reflects is a tree of
// cells, its mesh triangles and their quarters, with the exact mean of the interpolant on each. They need no
// links. A cut through the trees is a set of fragments (RadiositySolution).
//
// A cell's score says what its constant radiosity may cost where its light arrives: how far the interpolant
// deviates from its mean, relative to the light around, times how much of its view it can fill for the
// nearest patch that sees it. It is a measure to compare cells by; SourceCut finds what scores are worth.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct SourceCell {
  ElementId leaf = kNoElement;   // of the solution
  std::array<Vec3, 4> vertex;    // [m]
  std::int32_t size = 0;         // corners: 3 or 4
  std::int32_t parent = -1;      // in the list; -1: the cell is the whole leaf
  std::int32_t skip = 1;         // cells in this subtree, this one counted
  double area = 0;               // [m^2]
  Rgb irradiance = Rgb::Zero();  // its mean [W/m^2]
  double score = 0;              // [1]; none below it has a larger one
};

// A mesh, and what it was made of.
struct MeshWithLeaves {
  const ElementForest& forest;  // to which the leaves of the patches belong
  std::span<const PatchTriangulation> patches;
  const IrradianceMesh& mesh;
};

class SourceCells {
 public:
  // From a mesh whose leaves are the solution's or lie below them. Cells are divided while their score is
  // above `finest`, a few levels at most. `exact` tells who sees whom. Of no use if it was cancelled.
  // REQUIRES: the mesh's forest is the solution's or was grown from it.
  SourceCells(const RadiositySolution& solution, const MeshWithLeaves& shown, const PointIrradiance& exact,
              double finest, const ExecutionContext& context = ExecutionContext());

  // Depth first, leaf after leaf, leaves ascending.
  std::span<const SourceCell> cells() const { return cells_; }

  // The mean irradiance of each leaf by the interpolants, indexed by element; that of the solution for leaves
  // that do not reflect [W/m^2].
  std::vector<Rgb> LeafIrradiance() const;

  // How far the leaves' means are from these: what 1 % of the area that reflects exceeds, relative to these
  // or to 1 % of their mean, in any channel.
  double Change() const;

  // The cells with a score of at most `score` whose parents have more, and those that have no parts.
  std::vector<std::int32_t> Cut(double score) const;
  // They as fragments, without those that are whole leaves unless these are asked for.
  std::vector<Fragment> Fragments(std::span<const std::int32_t> cut, bool whole_leaves) const;

 private:
  void Collect(const std::vector<std::vector<SourceCell>>& by_patch);

  const RadiositySolution& solution_;
  std::vector<SourceCell> cells_;
};

}  // namespace penumbra
