// mesh/refinement/source_cells.h
//
// Sources that are finer than the solution's leaves, derived from the interpolants. Each leaf that reflects
// is the root of a tree of cells: the leaf's mesh triangles, and quarters of triangles. Each cell has the
// exact mean of the interpolant over the cell. Cells need no links. A cut contains exactly one cell on every
// path from a root to a cell without children; each cut defines a set of fragments
// (RadiositySolution::fragments).
//
// The score of a cell estimates the error at receivers that is caused by treating the radiosity of the cell
// as constant: (deviation of the interpolant from its mean, relative to the surrounding light) * (largest
// form factor of a point of the nearest patch to the cell). Scores are used only to compare cells;
// ChooseSourceCut() measures the error that corresponds to a score.

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

// A mesh, together with its leaves and triangulations.
struct MeshWithLeaves {
  const ElementForest& forest;  // the forest of the patches' leaves
  std::span<const PatchTriangulation> patches;
  const IrradianceMesh& mesh;
};

class SourceCells {
 public:
  // Divides cells whose score is above `finest`, at most a few times in succession. `exact` is used to find
  // the patches that a leaf sees. If cancelled, the object is incomplete. REQUIRES: the mesh's forest is the
  // solution's forest or a refinement of it.
  SourceCells(const RadiositySolution& solution, const MeshWithLeaves& shown, const PointIrradiance& exact,
              double finest, const ExecutionContext& context = ExecutionContext());

  // All cells, in the order of leaves, and in depth-first order for each leaf.
  std::span<const SourceCell> cells() const { return cells_; }

  // The irradiance of each element [W/m^2]: for leaves that reflect, the mean of the interpolants; otherwise
  // the solution's irradiance.
  std::vector<Rgb> LeafIrradiance() const;

  // The 99th percentile, by reflecting area, of the difference between the irradiance of a leaf in the
  // solution and the mean of the interpolants over the leaf. Differences are relative to max(mean of the
  // leaf, 1 % of the mean over all leaves); the largest channel counts.
  double Change() const;

  // Descends the tree of each leaf, and stops at cells whose score is at most `score` and at cells without
  // children. Returns the indices of the cells where the descent stops.
  std::vector<std::int32_t> Cut(double score) const;
  // The cells of a cut as fragments. Cells that are whole leaves are included only if `whole_leaves` is true.
  std::vector<Fragment> Fragments(std::span<const std::int32_t> cut, bool whole_leaves) const;

 private:
  void Collect(const std::vector<std::vector<SourceCell>>& by_patch);

  const RadiositySolution& solution_;
  std::vector<SourceCell> cells_;
};

}  // namespace penumbra
