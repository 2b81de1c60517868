// solver/transport/solvers/full_matrix_solver.h

#pragma once

#include <cstdint>
#include <vector>

#include "solver/transport/solvers/uniform_solver.h"

namespace penumbra {

// Gathering with the matrix of all form factors between elements (Goral, Torrance, Greenberg and Battaile
// 1984; Cohen and Greenberg 1985; Ashdown 1994, 6.1). A step of the solver is a sweep over all elements. A
// Jacobi sweep adds one reflection; a Gauss-Seidel sweep updates element after element from the newest
// radiosities.
class FullMatrixSolver final : public UniformSolver {
 public:
  // Computes the matrix of form factors. Throws InputError if the mesh has more than kMostDenseUnknowns
  // elements.
  FullMatrixSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options,
                   const ExecutionContext& context);

 private:
  struct Entry {
    std::int32_t source = 0;  // index of the source element in leaves()
    double factor = 0;
  };
  bool Assemble(const ExecutionContext& context);
  // Makes one sweep over all elements. The residual is rho / (1 - rho) * (largest change of a radiosity) /
  // (largest reflected radiosity), where rho is the largest reflectance of the scene.
  bool Advance(IterationReport* report, const ExecutionContext& context) override;
  Rgb Gather(std::size_t leaf, std::span<const Rgb> radiosity) const;

  // index of the first matrix entry of each leaf; the last element is the number of entries
  std::vector<std::size_t> first_;
  std::vector<Entry> entries_;
  std::vector<Rgb> irradiance_, radiosity_;  // irradiance and radiosity of each leaf [W/m^2]
};

LightSolverRegistry::Method FullMatrixSolverMethod();

}  // namespace penumbra
