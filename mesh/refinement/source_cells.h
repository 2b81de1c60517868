// mesh/refinement/source_cells.h
//
// Sources that are finer than the solution's leaves, derived from the interpolants. Each leaf that reflects
// is the root of a tree of cells: the leaf's mesh triangles, and quarters of triangles. Each cell has the
// exact mean of the interpolant over the cell. Cells need no links. A cut through the trees gives a set of
// fragments (RadiositySolution).
//
// A cell's score estimates the error that the cell's constant radiosity causes where its light arrives:
// (deviation of the interpolant from its mean, relative to the light around) * (largest fraction of the view
// that the cell fills from the nearest patch that sees it). Scores only compare cells with each other;
// SourceCut determines the error for a given score.

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
  std::int32_t size = 0;         // number of corners: 3 or 4
  std::int32_t parent = -1;      // index in the list; -1: the cell is the whole leaf
  std::int32_t skip = 1;         // number of cells in this subtree, including this cell
  double area = 0;               // [m^2]
  Rgb irradiance = Rgb::Zero();  // mean over the cell [W/m^2]
  double score = 0;              // [1]; at least the scores of all cells below
};

// A mesh, and the leaves and triangulations of the mesh.
struct MeshWithLeaves {
  const ElementForest& forest;  // the forest of the patches' leaves
  std::span<const PatchTriangulation> patches;
  const IrradianceMesh& mesh;
};

class SourceCells {
 public:
  // Divides cells while their score is above `finest`, a few levels at most. `exact` tells which patches a
  // leaf sees. If cancelled, the object is incomplete. REQUIRES: the mesh's forest is the solution's or grown
  // from it.
  SourceCells(const RadiositySolution& solution, const MeshWithLeaves& shown, const PointIrradiance& exact,
              double finest, const ExecutionContext& context = ExecutionContext());

  // In the order of leaves, and depth first for each leaf.
  std::span<const SourceCell> cells() const { return cells_; }

  // The irradiance of each element [W/m^2]: for leaves that reflect, the mean of the interpolants; otherwise
  // the solution's irradiance.
  std::vector<Rgb> LeafIrradiance() const;

  // The change of the leaves' irradiance from the solution to the means of the interpolants: the value that 1
  // % of the reflecting area exceeds. Changes are relative to max(mean of the leaf, 1 % of the mean over all
  // leaves), the largest over the channels.
  double Change() const;

  // The indices of the first cells, on the way down from each leaf, that have a score of at most `score` or
  // no children.
  std::vector<std::int32_t> Cut(double score) const;
  // The cells of a cut as fragments. Cells that are whole leaves are included only if `whole_leaves` is true.
  std::vector<Fragment> Fragments(std::span<const std::int32_t> cut, bool whole_leaves) const;

 private:
  void Collect(const std::vector<std::vector<SourceCell>>& by_patch);

  const RadiositySolution& solution_;
  std::vector<SourceCell> cells_;
};

}  // namespace penumbra
