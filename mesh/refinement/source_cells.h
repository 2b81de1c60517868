// mesh/refinement/source_cells.h
//
// Sources that are finer than the solution's leaves. Each leaf that reflects is the root of a tree of cells:
// the pieces into which contacts cut the leaf, if there are any; the quarters of the leaf or of a piece;
// quarters of quarters. Each cell has the exact mean of the interpolants over the cell. Cells need no links.
// Their places depend on the leaf alone, so that the same cells can carry another light.
//
// The score of a cell estimates the error at receivers that is caused by treating the radiosity of the cell
// as constant: (deviation of the interpolants from their mean, relative to the surrounding light) * (largest
// form factor of a point of the nearest patch to the cell).

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
  ElementId leaf = kNoElement;  // of the solution
  SourcePolygon polygon;
  std::int32_t parent = -1;      // index in the list; -1: the cell is the whole leaf
  std::int32_t skip = 1;         // number of cells in this subtree, including this cell
  double area = 0;               // [m^2]
  Rgb irradiance = Rgb::Zero();  // mean over the cell [W/m^2]
  double score = 0;              // [1]
};

// A mesh, together with its leaves and triangulations.
struct MeshWithLeaves {
  const ElementForest& forest;  // the forest of the patches' leaves
  std::span<const PatchTriangulation> patches;
  const IrradianceMesh& mesh;
};

struct SourceCellOptions {
  double finest = 0;  // cells with higher scores are divided
  // Cells for an earlier light of the same solution, or none: cells that were divided then are divided now.
  std::span<const SourceCell> before;
};

class SourceCells {
 public:
  // Divides cells whose score is above options.finest, down to a fraction of the mesh's triangles. `exact` is
  // used to find the patches that a leaf sees. If cancelled, the object is incomplete. REQUIRES: the mesh's
  // forest is the solution's forest or a refinement of it.
  SourceCells(const RadiositySolution& solution, const MeshWithLeaves& shown, const PointIrradiance& exact,
              const SourceCellOptions& options, const ExecutionContext& context = ExecutionContext());

  // All cells, in the order of leaves, and in depth-first order for each leaf.
  std::span<const SourceCell> cells() const { return cells_; }
  std::vector<SourceCell> TakeCells() && { return std::move(cells_); }

  // The irradiance of each element [W/m^2]: for leaves that reflect, the mean of the interpolants; otherwise
  // the solution's irradiance.
  std::vector<Rgb> LeafIrradiance() const;

  // The 99th percentile, by reflecting area, of the difference between the irradiance of a leaf in the
  // solution and the mean of the interpolants over the leaf. Differences are relative to max(mean of the
  // leaf, 1 % of the mean over all leaves); the largest channel counts.
  double Change() const;

  // The cells without children as fragments. Cells that are whole leaves are included only if `whole_leaves`
  // is true.
  std::vector<Fragment> Fragments(bool whole_leaves) const;

 private:
  void Collect(const std::vector<std::vector<SourceCell>>& by_patch);

  const RadiositySolution& solution_;
  std::vector<SourceCell> cells_;
};

}  // namespace penumbra
