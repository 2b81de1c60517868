#include "python/python_solution.h"

#include <utility>

#include "apps/solve_run.h"
#include "solver/visibility/exact/occlusion_methods.h"
#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {
namespace {

constexpr const char* kUsualMethod = "auto";

}  // namespace

PythonSolution::PythonSolution(PythonScene scene, std::unique_ptr<Pipeline> pipeline,
                               nlohmann::ordered_json options, bool measured)
    : scene_(std::move(scene)),
      pipeline_(std::move(pipeline)),
      options_(std::move(options)),
      measured_(measured) {}

std::shared_ptr<PythonSolution> PythonSolution::Load(const std::string& path) {
  LoadedScene loaded = LoadSolution(path);
  StoredSolve& stored = *loaded.stored;
  PythonScene scene;
  scene.scene = std::shared_ptr<const Scene>(std::move(loaded.owner));
  scene.arguments.scene = path;
  auto pipeline = std::make_unique<Pipeline>(*scene.scene, stored.solving, std::move(stored.state));
  return std::make_shared<PythonSolution>(std::move(scene), std::move(pipeline), std::move(stored.options),
                                          true);
}

std::vector<Measurement> PythonSolution::Probe(const std::vector<ProbePoint>& points,
                                               const ProbeRequest& request,
                                               const ExecutionContext& context) const {
  {
    const std::lock_guard lock(probing_);
    if (!irradiance_) {
      irradiance_ = std::make_unique<const PointIrradiance>(pipeline_->solution(), pipeline_->visibility(),
                                                            pipeline_->options().point);
      prober_ = std::make_unique<const Prober>(*scene_.scene, *irradiance_, pipeline_.get(), false);
    }
  }
  if (request.method == kUsualMethod)
    return request.parts ? MakeProber(*irradiance_, true).Measure(points, context)
                         : prober_->Measure(points, context);
  PointIrradianceOptions how = pipeline_->options().point;
  const std::unique_ptr<const OcclusionMethod> method =
      OcclusionMethods().Make(request.method, {how.min_backprojection_segment});
  how.method = method.get();
  const PointIrradiance irradiance(pipeline_->solution(), pipeline_->visibility(), how);
  return MakeProber(irradiance, request.parts).Measure(points, context);
}

void PythonSolution::Measure(const ExecutionContext& context) {
  if (measured_) return;
  pipeline_->Measure(context);
  measured_ = !context.Cancelled();
}

std::string PythonSolution::FileBytes() const { return SolutionFileOf(*pipeline_, options_); }

const IrradianceMesh* PythonSolution::MeshOfKind(MeshKind kind, const ExecutionContext& context) const {
  if (kind == MeshKind::kInterpolant || kind == pipeline_->mesh_kind()) return &pipeline_->mesh();
  const auto found = other_meshes_.find(kind);
  if (found != other_meshes_.end()) return &found->second;
  // As from a solution file: another pipeline makes other meshes of the same light.
  PipelineState state{pipeline_->visibility(), pipeline_->solution(), MeshKind::kInterpolant,
                      pipeline_->mesh(), pipeline_->report()};
  Pipeline other(*scene_.scene, pipeline_->options(), std::move(state));
  other.BuildMesh(kind, context);
  if (context.Cancelled()) return nullptr;
  return &(other_meshes_[kind] = other.mesh());
}

}  // namespace penumbra
