// solver/visibility/area/form_factor_matrix.h
//
// The form factors between all faces, or all objects, of a scene, with exact occlusion.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/scene/scene.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {

// A sparse matrix in compressed rows: row i holds the entries first[i] to first[i + 1] - 1, in ascending
// columns. Factors that are 0 are left out.
struct FormFactorMatrix {
  std::vector<double> area;  // of each row's fronts [m^2]; 0 if nothing is left of them
  std::vector<std::size_t> first;
  std::vector<std::int32_t> column;
  std::vector<double> factor;  // the fraction of the diffuse flux of the row that reaches the column
  std::vector<double> error;   // an upper estimate of |factor - true factor|
  std::size_t pairs = 0;       // of convex parts whose factor was computed, each once

  std::size_t Rows() const { return area.size(); }
  // The sum of the row's factors: 1 in a closed scene of which the row sees fronts only.
  double RowSum(std::size_t row) const;
  // An upper estimate of the error of RowSum().
  double RowError(std::size_t row) const;
  // Refers the rows to other areas [m^2]: F_ij becomes A_i F_ij / (new A_i), so that exchanges stay. A row
  // without factors takes any area; a row with factors keeps its area where the new one is 0. REQUIRES: one
  // area per row.
  void ReferTo(const std::vector<double>& areas);
  // The largest |A_i F_ij - A_j F_ji| / (A_i F_ij) over all entries; 0 for an empty matrix.
  double ReciprocityError() const;
};

struct FormFactorMatrixOptions {
  // The errors of a row's factors shall add up to at most this.
  double tolerance = 1e-6;
  // The method that computes occlusion at each point; null selects the fastest exact method.
  const OcclusionMethod* method = nullptr;
  // If not null, receives progress and may cancel the computation; the result is then useless.
  const ExecutionContext* context = nullptr;
};

// The form factors between the groups, past all patches of the scene as blockers. A group is a list of parts,
// and a part belongs to one group only; the factor of a group to itself counts its own parts that see each
// other. Each pair of parts that may see each other is integrated once, so that A_i F_ij = A_j F_ji up to the
// rounding of one division; the others are found by PatchVisibility. First comes a rough estimate of each
// pair with blockers; then the pairs are computed anew whose errors make up too much of the error of a row.
// Runs in parallel; the result does not depend on the number of threads.
FormFactorMatrix ComputeFormFactorMatrix(const Scene& scene, std::span<const std::vector<AreaPart>> groups,
                                         const FormFactorMatrixOptions& options = {});

}  // namespace penumbra
