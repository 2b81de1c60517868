// solver/transport/solvers/sampled_solver.h
//
// A solver for scenes of many polygons. The light transport operator is a sparse matrix of form factors that
// rays sample by Malley's method (Ashdown 1994, 4.12). A row of the matrix lists the cells that the rays of
// one cell hit; each hit adds 1 / (number of rays) to the form factor. In the sampled solver, a cell is
// either a whole leaf of a quadtree, or a fragment of a leaf that other surfaces touch or cross
// (CutLeavesAtContacts), because the irradiances on the two sides of a wall are unrelated. The sampled solver
// makes no links and no pairs of patches, so that time and memory grow in proportion to the number of
// elements. In closed rooms, each row of the sampled matrix adds up to 1. Direct light is computed by shadow
// rays. The sampled matrix is kept, so that light for other emittances needs no new rays for the matrix.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "solver/transport/links/push_pull.h"
#include "solver/transport/points/shadow_rays.h"
#include "solver/transport/solvers/light_solver.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

class SampledSolver final : public LightSolver {
 public:
  // The scene must outlive the solver.
  SampledSolver(const Scene& scene, const SampledOptions& options);

  bool Ready() const override { return true; }
  std::optional<SolverStep> Next() const override;
  // Makes one pass of the sampled solver: divides the elements whose direct light varies, samples the matrix
  // of form factors anew, and sweeps until the light converges. Each pass of the sampled solver allows
  // smaller elements and casts more rays than the previous pass.
  bool Step(SolverStep step, const ExecutionContext& context) override;
  bool Converged() const override {
    return pass_ >= options_.passes && residual_ <= options_.relative_cutoff;
  }
  const RadiositySolution& solution() const override { return solution_; }
  const SolverReport& report() const override { return report_; }
  bool Relight(const ExecutionContext& context) override;
  bool TakesLight() const override { return false; }
  bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                const ExecutionContext& context) override;
  std::unique_ptr<LightSolver> LitAs(const Scene& other, const ExecutionContext& context) const override;
  void ReplaceLight(std::span<const Rgb> element, std::span<const Rgb> fragment) override;
  double PartOfTolerance() const override { return 1; }
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) override;
  std::vector<Rgb> MeanIrradianceByBounce(int bounces) const override;

 private:
  // The direct light of an element or a fragment, from points in its four quarters [W/m^2].
  struct Direct {
    // The mean of the direct light, and the root mean square deviation of the direct light from this mean.
    Rgb mean = Rgb::Zero(), spread = Rgb::Zero();
  };
  // The limits of one pass of the sampled solver.
  struct Limits {
    double largest_area;  // largest allowed area of an element [m^2]
    // Largest allowed (root mean square deviation) / mean of an element's direct light.
    double relative_spread;
    std::size_t rays;  // number of rays that each element casts
  };

  // A receiver and sender of light: a whole leaf of a quadtree, or one fragment of a cut leaf.
  struct Cell {
    ElementId leaf = kNoElement;
    std::int32_t fragment = -1;  // index in RadiositySolution::fragments; -1 if the cell is a whole leaf
  };
  // The data, apart from the elements, that a pass of the sampled solver replaces, and that are restored if
  // the pass is cancelled.
  struct Transport {
    std::vector<Fragment> fragments;
    std::vector<Cell> cells;
    std::shared_ptr<const std::vector<std::int32_t>> rows;
    std::size_t rays = 0;
  };

  Limits LimitsOf(int pass) const;
  std::span<const Vec3> PolygonOf(const Cell& cell) const;
  double AreaOf(const Cell& cell) const;
  const Rgb& ReflectanceOf(const Cell& cell) const;
  const Direct& DirectOf(const Cell& cell) const;
  Direct DirectOn(PatchId patch, std::span<const Vec3> polygon, std::uint64_t seed) const;
  bool MustDivide(ElementId element, const Limits& limits, double least_flux) const;
  void Divide(const Limits& limits, const ExecutionContext& context);
  static void DealDirect(std::span<Direct> light, const std::function<void(std::size_t i)>& compute);
  void LightNewElements(const ExecutionContext& context);
  void LightFragments(const ExecutionContext& context);
  void FindCells(const ExecutionContext& context);
  void SetLightOf(std::span<const Rgb> irradiance);
  void GoBackTo(std::size_t elements, Transport before);
  void SampleMatrix(std::size_t rays, const ExecutionContext& context);
  std::vector<Rgb> Gather(std::span<const Rgb> irradiance) const;
  std::size_t Settle(const ExecutionContext& context);
  void Report(std::size_t sweeps, double seconds);

  // Makes a solver for another scene with the same elements and the same matrix of form factors; its light is
  // not computed yet.
  SampledSolver(const SampledSolver& from, const Scene& other);

  const Scene& scene_;
  SampledOptions options_;
  std::shared_ptr<const RayCaster> caster_;
  std::unique_ptr<const ShadowRays> shadows_;  // shadow rays to the emitters, for the present emittances
  RadiositySolution solution_;
  PushPull push_pull_;
  std::vector<Direct> direct_;              // direct light of each element
  std::vector<Direct> direct_of_fragment_;  // direct light of each fragment
  std::vector<Cell> cells_;                 // the cells of all leaves, in the order of push_pull_.leaves()
  // For each cell, rays_ entries, one for each ray from the cell: the index in cells_ of the cell that the
  // ray hits, or -1 if the ray hits no front.
  std::shared_ptr<const std::vector<std::int32_t>> rows_;
  std::size_t rays_ = 0;
  int pass_ = 0;
  double residual_ = 1;
  SolverReport report_;
  PatchVisibility no_pairs_;
  LeafVisibilityCache seen_from_leaves_;
};

LightSolverRegistry::Method SampledSolverMethod();

}  // namespace penumbra
