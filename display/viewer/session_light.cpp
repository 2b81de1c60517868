// Lamps and materials that change while they are looked at: light over the transport that is kept.

#include <fmt/format.h>

#include <utility>

#include "display/viewer/leaf_mesh.h"
#include "display/viewer/solver_session.h"
#include "mesh/refinement/emitter_light.h"
#include "solver/base/check.h"
#include "solver/transport/links/push_pull.h"

namespace penumbra::viewer {
namespace {

// The light of each lamp is kept while there are so many at most: it takes the memory of a mesh each.
constexpr std::size_t kMostLampsKept = 24;

// The light of a state, as if of one emitter.
EmitterLight LightOfState(PipelineState state, std::vector<PatchId> patches) {
  EmitterLight light;
  light.patches = std::move(patches);
  light.element = std::move(state.solution.irradiance);
  for (const Fragment& fragment : state.solution.fragments) light.fragment.push_back(fragment.irradiance);
  light.interpolant = std::move(state.mesh.irradiance);
  return light;
}

// The factor of each light; nothing if the patches of one have several.
std::optional<std::vector<Rgb>> FactorsOf(const std::vector<EmitterLight>& lights,
                                          const std::vector<Rgb>& of_patch) {
  std::vector<Rgb> factors;
  for (const EmitterLight& light : lights) {
    factors.push_back(of_patch[static_cast<std::size_t>(light.patches[0])]);
    for (const PatchId patch : light.patches)
      if ((of_patch[static_cast<std::size_t>(patch)] != factors.back()).any()) return std::nullopt;
  }
  return factors;
}

}  // namespace

// The light of lamps with factors, as the sum of what each sends. Nothing if the lamps are too many, or were
// not kept by the solution of a file.
std::optional<EmitterLight> SolverSession::SumOfLamps(const LightChange& change) {
  if (!change.paints.empty() || !held_->scene_change.empty()) return std::nullopt;
  const bool current = lamps_of_ == held_.get() && lamps_at_ == held_->changes && !lamps_.empty();
  if (!current) {
    lamps_.clear();
    lamps_of_ = held_.get();
    lamps_at_ = held_->changes;
    if (held_->stored) {
      for (const EmitterLight& light : pipeline().emitters()) lamps_.push_back(light);
    } else {
      const std::vector<Lamp> lamps = LampsOf(*held_->scene);
      if (lamps.size() > kMostLampsKept) return std::nullopt;
      for (const Lamp& lamp : lamps) {
        const Scene alone = LitOnlyBy(*held_->scene, lamp.patches);
        std::optional<PipelineState> lit = pipeline().LitBy(alone);
        if (!lit) {
          lamps_.clear();
          return std::nullopt;
        }
        lamps_.push_back(LightOfState(std::move(*lit), lamp.patches));
      }
    }
  }
  if (lamps_.empty()) return std::nullopt;
  const std::optional<std::vector<Rgb>> factors =
      FactorsOf(lamps_, DimmingFactors(*held_->scene, change.lamps));
  if (!factors) return std::nullopt;
  return SumOf(lamps_, *factors);
}

// A snapshot of the scene with this light on the present elements and mesh.
void SolverSession::PublishLit(std::shared_ptr<const Scene> scene, const EmitterLight& light) {
  RadiositySolution solution = unlit_->light->solution();
  solution.forest = solution.forest.Of(*scene);
  ReplaceIrradiance(light.element, light.fragment, solution);
  IrradianceMesh mesh = unlit_->Mesh(MeshKind::kInterpolant)->mesh();
  mesh.irradiance = light.interpolant;
  auto next = std::make_shared<Snapshot>(*unlit_);
  next->measured.reset();
  next->scene = scene;
  next->mesh = {};
  next->mesh[static_cast<std::size_t>(MeshKind::kFlat)] =
      std::make_shared<const MeshState>(scene, LeafMesh(solution.forest, solution.irradiance));
  next->mesh[static_cast<std::size_t>(MeshKind::kInterpolant)] =
      std::make_shared<const MeshState>(scene, std::move(mesh));
  next->light =
      std::make_shared<const LightState>(std::move(scene), held_->visibility, std::move(solution),
                                         pipeline().options().point, pipeline().resolved().discontinuities);
  Publish(std::move(next));
}

void SolverSession::DoLight(const LightChange& change, const ExecutionContext& context) {
  auto scene = change.empty() ? opened_ : std::make_shared<const Scene>(Changed(*opened_, change));
  if (!held_) {  // nothing is lit yet: what comes will be
    change_ = change;
    const std::shared_ptr<const Snapshot> before = snapshot();
    auto next = std::make_shared<Snapshot>(*before);
    next->scene = scene;
    next->mesh = {};
    const ElementForest roots(*scene);
    next->mesh[static_cast<std::size_t>(MeshKind::kFlat)] = std::make_shared<const MeshState>(
        scene, LeafMesh(roots, std::vector<Rgb>(roots.size(), Rgb::Zero())));
    return Publish(std::move(next));
  }
  Begin(SolveStage::kOperator);
  if (!IsLit()) DoInterpolants(context);
  if (context.Cancelled()) return;
  if (!IsLit() && !snapshot()->Mesh(MeshKind::kInterpolant))
    throw InputError("lamps are dimmed over interpolants, and none were made");
  if (change == held_->scene_change) {
    change_ = change;
    if (!IsLit()) {  // asked to be ready for a change
      if (!held_->stored && pipeline().OperatorBytes() == 0) pipeline().KeepOperator(context);
      if (!context.Cancelled()) static_cast<void>(SumOfLamps(change));
      return;
    }
    auto back = std::make_shared<Snapshot>(*std::exchange(unlit_, nullptr));
    return Publish(std::move(back));
  }
  if (!held_->stored && pipeline().OperatorBytes() == 0 && !pipeline().KeepOperator(context)) {
    if (context.Cancelled()) return;
    throw InputError("this method keeps no transport: iterate, to solve the changed scene");
  }
  std::optional<EmitterLight> light = SumOfLamps(change);
  if (!light && !held_->stored)
    if (std::optional<PipelineState> state = pipeline().LitBy(*scene))
      light = LightOfState(std::move(*state), {});
  if (!light)
    throw InputError(
        held_->stored
            ? "the solution of this file does not keep the light of each lamp: iterate, to solve the scene"
            : "something shines that did not when the scene was solved: iterate, to solve it anew");
  if (!IsLit()) unlit_ = snapshot();
  change_ = change;
  PublishLit(std::move(scene), *light);
}

// The state that a file of the changed light has.
std::optional<PipelineState> SolverSession::LitState() const {
  const std::shared_ptr<const Snapshot> now = snapshot();
  PipelineState state;
  state.visibility = *held_->visibility;
  state.solution = now->light->solution();
  state.mesh = now->Mesh(MeshKind::kInterpolant)->mesh();
  state.report.counts = pipeline().report().counts;
  state.report.interactions = pipeline().report().interactions;
  state.report.iterations = pipeline().report().iterations;
  state.report.error_asked = pipeline().report().error_asked;
  return state;
}

}  // namespace penumbra::viewer
