// solver/transport/solvers/uniform_solver.h
//
// The common base class of the classic solvers, which use a uniform mesh of elements with constant radiosity
// and make steps until the missing light is small. Meshing and probes gather light from the elements in the
// same way as for the other solvers.

#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "solver/transport/links/push_pull.h"
#include "solver/transport/solvers/light_solver.h"

namespace penumbra {

class UniformSolver : public LightSolver {
 public:
  bool Ready() const final { return ready_; }
  std::optional<SolverStep> Next() const final;
  // Makes one step of the solver's method: a shot, a sweep or a bundle of rays.
  bool Step(SolverStep step, const ExecutionContext& context) final;
  bool Converged() const override { return ready_ && residual_ <= options_.relative_cutoff; }
  const RadiositySolution& solution() const final { return solution_; }
  const SolverReport& report() const final { return report_; }
  // Relight() always returns false: new emittances need a new solver, because form factors or rays were
  // chosen according to the old light.
  bool Relight(const ExecutionContext&) final { return false; }
  bool TakesLight() const final { return false; }
  bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                const ExecutionContext& context) final;
  double PartOfTolerance() const final { return 1; }
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) final;
  std::vector<Rgb> MeanIrradianceByBounce(int) const final { return {}; }

 protected:
  // Makes the uniform mesh, with emittance as its only light. `most_steps` is the largest number of steps if
  // UniformOptions::shots is 0. The scene and the visibility must outlive the solver.
  UniformSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options,
                std::size_t most_steps);

  // Makes one step of the derived class's method and sets residual and sweeps of the report. If cancelled,
  // Advance() returns false and changes nothing.
  virtual bool Advance(IterationReport* report, const ExecutionContext& context) = 0;

  // Constructors of classes derived from UniformSolver call SetReady() unless the construction was cancelled.
  void SetReady() { ready_ = true; }
  // Sets the irradiance of each leaf of solution() [W/m^2], and the resulting radiosities.
  void Show(std::span<const Rgb> irradiance);

  const Scene& scene() const { return scene_; }
  const ElementForest& forest() const { return solution_.forest; }
  const PatchVisibility& visibility() const { return visibility_; }
  const UniformOptions& options() const { return options_; }
  // All leaves (undivided elements of the quadtrees), patch by patch.
  std::span<const ElementId> leaves() const { return push_pull_.leaves(); }
  // The leaves of patch p are leaves()[FirstLeaf(p)] to leaves()[FirstLeaf(p + 1) - 1].
  std::size_t FirstLeaf(PatchId patch) const { return first_leaf_[static_cast<std::size_t>(patch)]; }
  double AreaOf(std::size_t leaf) const { return solution_.forest[leaves()[leaf]].area; }
  const Material& MaterialOf(std::size_t leaf) const {
    return scene_.MaterialOf(solution_.forest[leaves()[leaf]].patch);
  }
  // The flux that all emitters emit [W].
  Rgb EmittedFlux() const;

 private:
  const Scene& scene_;
  const PatchVisibility& visibility_;
  UniformOptions options_;
  RadiositySolution solution_;
  PushPull push_pull_;
  std::vector<std::size_t> first_leaf_;
  bool ready_ = false;
  double residual_ = 1;
  std::size_t most_steps_;
  SolverReport report_;
  LeafVisibilityCache seen_from_leaves_;
};

// Makes a solver of the class `Solver`, which is derived from UniformSolver. Returns null if the solver is
// asked to continue from another solution, which solvers on uniform meshes cannot do.
template <class Solver>
std::unique_ptr<LightSolver> MakeUniformSolver(const SolverScene& in, const LightSolverOptions& options,
                                               const ExecutionContext& context) {
  if (in.goes_on_from) return nullptr;
  return std::make_unique<Solver>(in.scene, in.pairs(context), options.uniform, context);
}

}  // namespace penumbra
