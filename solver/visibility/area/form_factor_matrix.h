// solver/visibility/area/form_factor_matrix.h
//
// The matrix of the form factors between all faces, or between all objects, of a scene, with exact occlusion.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/scene/scene.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {

// A sparse matrix of form factors, stored as compressed rows: row i holds the entries first[i] to first[i +
// 1] - 1, in ascending columns. Form factors that are 0 are not stored.
struct FormFactorMatrix {
  std::vector<double> area;  // front area of each row's face or object [m^2]; 0 if no front remains
  std::vector<std::size_t> first;
  std::vector<std::int32_t> column;
  std::vector<double> factor;  // form factor: fraction of the row's diffuse flux that reaches the column
  std::vector<double> error;   // upper estimates of the errors |factor - true form factor|
  std::size_t pairs = 0;       // the number of pairs of convex parts of faces whose form factor was computed

  std::size_t Rows() const { return area.size(); }
  // The sum of the form factors of a row. In a closed scene, the form factors of a row add up to 1 if only
  // fronts are visible from the row's face or object.
  double RowSum(std::size_t row) const;
  // An upper estimate of the error of RowSum().
  double RowError(std::size_t row) const;
  // Replaces the areas A_i of the rows by other areas [m^2]: F_ij becomes A_i F_ij / (new A_i), so that the
  // exchange A_i F_ij does not change. A row with form factors keeps its old area if its new area is 0.
  // REQUIRES: `areas` has one entry for each row.
  void ReferTo(const std::vector<double>& areas);
  // The largest relative error of reciprocity, |A_i F_ij - A_j F_ji| / (A_i F_ij), over all entries; 0 for an
  // empty matrix.
  double ReciprocityError() const;
};

struct FormFactorMatrixOptions {
  // The largest permissible sum of the errors of the form factors of one row.
  double tolerance = 1e-6;
  // The method that computes occlusion at each point; null selects the fastest exact method.
  const OcclusionMethod* method = nullptr;
  // If not null, a context that receives progress and may cancel the computation. The result of a cancelled
  // computation is useless.
  const ExecutionContext* context = nullptr;
};

// Computes the form factors between groups of parts, with all patches of the scene as blockers. A group is a
// list of convex parts of patches, and a part belongs to one group only. The form factor of a group to itself
// accounts for parts of the group that see each other. Each pair of parts that may see each other
// (PatchVisibility) is integrated once, so that A_i F_ij = A_j F_ji up to the rounding error of one division.
// First, the form factor of each pair of parts with blockers is estimated roughly; then the form factors that
// contribute too much to the error of a row are computed again, with smaller errors. The computation runs in
// parallel; the result does not depend on the number of threads.
FormFactorMatrix ComputeFormFactorMatrix(const Scene& scene, std::span<const std::vector<AreaPart>> groups,
                                         const FormFactorMatrixOptions& options = {});

}  // namespace penumbra
