// solver/transport/solvers/full_matrix_solver.h

#pragma once

#include <cstdint>
#include <vector>

#include "solver/transport/solvers/uniform_solver.h"

namespace penumbra {

// Gathering with the matrix of all form factors between elements (Goral, Torrance, Greenberg and Battaile
// 1984; Cohen and Greenberg 1985; Ashdown 1994, 6.1). A step is a sweep over all elements: Jacobi's, which
// adds one reflection, or Gauss and Seidel's, element after element with the newest light.
class FullMatrixSolver final : public UniformSolver {
 public:
  // Computes the matrix. Throws InputError if there are more than kMostDenseUnknowns elements.
  FullMatrixSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options,
                   const ExecutionContext& context);

 private:
  struct Entry {
    std::int32_t source = 0;  // in leaves()
    double factor = 0;
  };
  bool Assemble(const ExecutionContext& context);
  // A sweep. The residual is rho / (1 - rho) times the largest change of a radiosity, with the largest
  // reflectance rho, relative to the largest reflected radiosity.
  bool Advance(IterationReport* report, const ExecutionContext& context) override;
  Rgb Gather(std::size_t leaf, std::span<const Rgb> radiosity) const;

  std::vector<std::size_t> first_;  // of each leaf's entries, and one past the last
  std::vector<Entry> entries_;
  std::vector<Rgb> irradiance_, radiosity_;  // of each leaf [W/m^2]
};

LightSolverRegistry::Method FullMatrixSolverMethod();

}  // namespace penumbra
