#include "mesh/refinement/emitter_interpolants.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/row_sampler.h"
#include "solver/base/parallel.h"
#include "solver/scene/emitters.h"
#include "solver/transport/links/push_pull.h"

namespace penumbra {
namespace {

constexpr std::size_t kNodesATask = 64;

// The light of all emitters at the nodes of a mesh, in the order in which the builder of the mesh asks for
// them.
class NodesOfEmitters {
 public:
  NodesOfEmitters(const RowSampler& rows, std::vector<SourceSet> lights)
      : rows_(rows), lights_(std::move(lights)), values_(lights_.size()) {}

  // Records the light of all emitters at nodes, and gives their sum.
  IrradianceSampler Recorder(const ExecutionContext& context) {
    const auto many = [this, &context](std::span<const PatchPoint> points,
                                       std::span<PointIrradianceResult> results) {
      if (!context.Cancelled()) Record(points, results);
    };
    return IrradianceSampler::OfMany(many);
  }

  QuadraticInterpolant Interpolant(std::size_t emitter, const std::array<std::uint32_t, 6>& nodes) const {
    std::array<Rgb, 6> six;
    for (std::size_t k = 0; k < 6; ++k) six[k] = values_[emitter][nodes[k]];
    return QuadraticInterpolant::Quadratic(six);
  }
  std::size_t size() const { return size_; }

 private:
  void Record(std::span<const PatchPoint> points, std::span<PointIrradianceResult> results) {
    const std::vector<PointIrradianceResult> sampled = rows_.At(points);
    const std::size_t first = std::exchange(size_, size_ + points.size());
    for (std::vector<Rgb>& of_emitter : values_) of_emitter.resize(size_);
    ParallelFor(points.size(), kNodesATask, [&](std::size_t i) {
      Rgb sum = Rgb::Zero();
      for (std::size_t k = 0; k < lights_.size(); ++k)
        sum += values_[k][first + i] = Irradiance(*sampled[i].row, lights_[k]);
      results[i] = {sum, sampled[i].one_sided};
    });
  }

  const RowSampler& rows_;
  std::vector<SourceSet> lights_;
  std::vector<std::vector<Rgb>> values_;  // of each emitter at each node [W/m^2]
  std::size_t size_ = 0;                  // number of nodes
};

// One look at each node serves all emitters.
std::size_t ByRows(const EmitterInterpolation& in, std::span<EmitterLight> lights,
                   const ExecutionContext& context) {
  SourceSet sources = SourceSet::ForAnyLight(in.whole);
  std::vector<SourceSet> of_emitter;
  for (const EmitterLight& light : lights) {
    of_emitter.push_back(sources.WithLight(SourceLight(in.whole, light).View()));
    sources.TakeSpreads(of_emitter.back());
  }
  const PointIrradiance exact = in.exact.WithSources(std::move(sources));
  const RowSampler rows(exact, in.tolerance, nullptr, /*keep=*/false);
  NodesOfEmitters nodes(rows, std::move(of_emitter));
  const BuiltMesh built = BuildIrradianceMesh(in.whole.forest.scene(), in.triangulations,
                                              InterpolantOrder::kQuadratic, nodes.Recorder(context), context);
  if (context.Cancelled()) return 0;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    lights[k].interpolant.clear();
    for (const std::array<std::uint32_t, 6>& samples : built.sample_numbers)
      lights[k].interpolant.push_back(nodes.Interpolant(k, samples));
  }
  return nodes.size();
}

// Each emitter's own irradiance at each node.
std::size_t EmitterByEmitter(const EmitterInterpolation& in, std::span<EmitterLight> lights,
                             const ExecutionContext& context) {
  std::size_t evaluations = 0;
  for (EmitterLight& light : lights) {
    const Scene scene = LitOnlyBy(in.whole.forest.scene(), light.patches);
    RadiositySolution alone = in.whole;
    alone.forest = in.whole.forest.Of(scene);
    ReplaceIrradiance(light.element, light.fragment, alone);
    const std::unique_ptr<const PointIrradiance> exact = in.irradiance_of(alone);
    if (!exact || context.Cancelled()) return 0;
    const IrradianceSampler sampler = WhileGoing(NearSampler(*exact, in.tolerance), context);
    BuiltMesh built = BuildIrradianceMesh(in.whole.forest.scene(), in.triangulations,
                                          InterpolantOrder::kQuadratic, sampler, context);
    light.interpolant = std::move(built.mesh.irradiance);
    evaluations += built.point_evaluations;
  }
  return evaluations;
}

}  // namespace

std::size_t InterpolateByEmitter(const EmitterInterpolation& in, std::span<EmitterLight> lights,
                                 const ExecutionContext& context) {
  if (lights.empty()) return 0;
  context.Report("interpolate", 0);
  const std::size_t evaluations =
      in.exact.CanRecord() ? ByRows(in, lights, context) : EmitterByEmitter(in, lights, context);
  return context.Cancelled() ? 0 : evaluations;
}

}  // namespace penumbra
