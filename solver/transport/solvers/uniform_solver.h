// solver/transport/solvers/uniform_solver.h
//
// What the classic solvers have in common: a uniform mesh of elements with constant light, and steps until
// the light that is left out is small. Points and meshes gather from the elements as from those of the other
// solvers.

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
  // One step of the method: a shot, a sweep or a bundle of rays.
  bool Step(SolverStep step, const ExecutionContext& context) final;
  bool Converged() const override { return ready_ && residual_ <= options_.relative_cutoff; }
  const RadiositySolution& solution() const final { return solution_; }
  const SolverReport& report() const final { return report_; }
  // False: form factors were chosen by the light, or the rays by the power; a new solver is necessary.
  bool Relight(const ExecutionContext&) final { return false; }
  bool TakesLight() const final { return false; }
  bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                const ExecutionContext& context) final;
  double PartOfTolerance() const final { return 1; }
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) final;
  std::vector<Rgb> MeanIrradianceByBounce(int) const final { return {}; }

 protected:
  // Makes the mesh, lit by emittance only. `most_steps`: how many steps Next() asks for at most, if the
  // options do not say. The scene and the visibility must outlive the solver.
  UniformSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options,
                std::size_t most_steps);

  // Makes a step and sets the residual and the sweeps of the report. Returns false if cancelled, and then
  // changes nothing.
  virtual bool Advance(IterationReport* report, const ExecutionContext& context) = 0;

  // The constructors of derived classes call it if they were not cancelled.
  void SetReady() { ready_ = true; }
  // Hands on the light: the irradiance of each leaf [W/m^2].
  void Show(std::span<const Rgb> irradiance);

  const Scene& scene() const { return scene_; }
  const ElementForest& forest() const { return solution_.forest; }
  const PatchVisibility& visibility() const { return visibility_; }
  const UniformOptions& options() const { return options_; }
  // The leaves, patch by patch.
  std::span<const ElementId> leaves() const { return push_pull_.leaves(); }
  // The places of a patch's leaves in leaves(): from FirstLeaf(p) up to FirstLeaf(p + 1).
  std::size_t FirstLeaf(PatchId patch) const { return first_leaf_[static_cast<std::size_t>(patch)]; }
  double AreaOf(std::size_t leaf) const { return solution_.forest[leaves()[leaf]].area; }
  const Material& MaterialOf(std::size_t leaf) const {
    return scene_.MaterialOf(solution_.forest[leaves()[leaf]].patch);
  }
  // The flux that all surfaces emit of themselves [W].
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

// Makes a solver of this class; null where it should go on from another solution.
template <class Solver>
std::unique_ptr<LightSolver> MakeUniformSolver(const SolverScene& in, const LightSolverOptions& options,
                                               const ExecutionContext& context) {
  if (in.goes_on_from) return nullptr;
  return std::make_unique<Solver>(in.scene, in.pairs(context), options.uniform, context);
}

}  // namespace penumbra
