// mesh/refinement/source_cells.h
//
// Light sources that are smaller than the quadtree leaves of the solution. Each reflecting leaf is the root
// of a tree of cells, and each cell is a light source. If contacts (lines where the irradiance jumps) cut the
// leaf, the pieces of the leaf are the root's children. A cell that is not cut by contacts is either
// undivided, or divided into quarters. Each cell stores the exact mean of the irradiance interpolants over
// the cell. Unlike quadtree elements, cells need no links of their own. The shapes of the cells of a leaf
// depend on the leaf and not on the light, so that the same cells can carry another light.
//
// The score of a cell estimates the error at receivers that is caused by treating the radiosity of the cell
// as constant. The score of a cell is (deviation of the interpolants from their mean, relative to the
// surrounding light) * (largest form factor of a point of the nearest patch to the cell).

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/sources/source_polygon.h"

namespace penumbra {

struct SourceCell {
  ElementId leaf = kNoElement;  // the quadtree leaf of the solution that contains the source cell
  SourcePolygon polygon;
  // The index of the cell that was divided into this cell; -1 if the cell is a whole leaf.
  std::int32_t parent = -1;
  std::int32_t skip = 1;         // the number of cells in the subtree of this cell, including the cell itself
  double area = 0;               // the area of the source cell [m^2]
  Rgb irradiance = Rgb::Zero();  // the mean irradiance of the source cell [W/m^2]
  double score = 0;              // estimated relative error at receivers if the cell is not divided [1]
};

// A mesh, together with its leaves and triangulations.
struct MeshWithLeaves {
  const ElementForest& forest;  // the quadtrees of the patches
  std::span<const PatchTriangulation> patches;
  const IrradianceMesh& mesh;
};

struct SourceCellOptions {
  double finest = 0;  // largest score (estimated error) of a cell that is not divided
  // The cells for an earlier light of the same solution, or an empty list. Every cell that is divided in
  // `before` is divided again.
  std::span<const SourceCell> before;
};

class SourceCells {
 public:
  // Divides cells whose score (estimated error at receivers) is above options.finest, until cells are smaller
  // than a given fraction of the mesh's triangles. The irradiance `exact` is used only to find the patches
  // that a leaf sees. If the computation is cancelled, the list of cells is incomplete. REQUIRES: the mesh's
  // forest is the solution's forest or a refinement of it.
  SourceCells(const RadiositySolution& solution, const MeshWithLeaves& shown, const PointIrradiance& exact,
              const SourceCellOptions& options, const ExecutionContext& context = ExecutionContext());

  // All cells, in the order of the solution's leaves, and depth first within each leaf.
  std::span<const SourceCell> cells() const { return cells_; }
  std::vector<SourceCell> TakeCells() && { return std::move(cells_); }

  // The irradiance of each element [W/m^2]: for leaves that reflect, the mean of the interpolants; otherwise
  // the solution's irradiance.
  std::vector<Rgb> LeafIrradiance() const;

  // The 99th percentile of the differences between the irradiance of a leaf in the solution and the mean of
  // the interpolants over the leaf. The percentile that Change() returns is weighted by the reflecting area
  // of leaves. In Change(), these differences of irradiance are relative to max(mean irradiance of the leaf,
  // 1 % of the mean irradiance over all leaves), and the channel with the largest difference counts.
  double Change() const;

  // Converts the cells without children to fragments (convex pieces of leaves with their own radiosities).
  // Cells that are whole leaves become fragments only if `whole_leaves` is true.
  std::vector<Fragment> Fragments(bool whole_leaves) const;

 private:
  void Collect(const std::vector<std::vector<SourceCell>>& by_patch);

  const RadiositySolution& solution_;
  std::vector<SourceCell> cells_;
};

}  // namespace penumbra
