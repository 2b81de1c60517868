#include "display/viewer/solver_session.h"

#include <new>
#include <utility>

#include "display/viewer/leaf_mesh.h"
#include "mesh/local_pass.h"
#include "mesh/representation_error.h"
#include "mesh/source_error.h"
#include "solver/base/check.h"
#include "solver/transport/energy.h"
#include "solver/transport/solution_error.h"

namespace penumbra::viewer {
namespace {

// A scene before anything is known of its light.
std::shared_ptr<Snapshot> DarkSnapshot(std::shared_ptr<const Scene> scene) {
  auto snapshot = std::make_shared<Snapshot>();
  const ElementForest roots(*scene);
  const std::vector<Rgb> dark(roots.size(), Rgb::Zero());
  snapshot->mesh[static_cast<std::size_t>(MeshKind::kFlat)] =
      std::make_shared<const MeshState>(scene, LeafMesh(roots, dark));
  snapshot->scene = std::move(scene);
  return snapshot;
}

IrradianceSampler SamplerOf(const LightState& light) {
  const PointIrradiance* exact = &light.Exact();
  return [exact](PatchId patch, const ReceiverPoint& at) { return exact->OnPatch(patch, at); };
}

}  // namespace

SolverSession::SolverSession(std::shared_ptr<const Scene> scene, const PipelineOptions& options)
    : snapshot_(DarkSnapshot(std::move(scene))), options_(options), thread_([this] { Work(); }) {}

SolverSession::~SolverSession() {
  Cancel();
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

std::shared_ptr<const Snapshot> SolverSession::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

SessionStatus SolverSession::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

PipelineOptions SolverSession::options() const {
  const std::lock_guard lock(mutex_);
  return options_;
}

void SolverSession::SetOptions(const PipelineOptions& options) {
  const std::lock_guard lock(mutex_);
  options_ = options;
  stale_links_ = true;
}

void SolverSession::SetScene(std::shared_ptr<const Scene> scene) {
  Cancel();
  Enqueue("load", [this, scene](const ExecutionContext&) { Restart(scene); });
}

void SolverSession::Link() {
  Enqueue("link", [this](const ExecutionContext& context) { DoLink(context); });
}

void SolverSession::Iterate() {
  Enqueue("iterate", [this](const ExecutionContext& context) { DoIterate(context); });
}

void SolverSession::Converge() {
  Enqueue("iterate", [this](const ExecutionContext& context) { DoConverge(context); });
}

void SolverSession::Correct() {
  Enqueue("correct", [this](const ExecutionContext& context) { DoCorrect(context); });
}

void SolverSession::BuildMesh(MeshKind kind) {
  Enqueue("mesh", [this, kind](const ExecutionContext& context) { DoBuildMesh(kind, context); });
}

void SolverSession::Measure() {
  Enqueue("measure", [this](const ExecutionContext& context) { DoMeasure(context); });
}

void SolverSession::Run(const std::string& phase,
                        std::function<void(const Snapshot&, const ExecutionContext&)> work) {
  Enqueue(phase, [this, work = std::move(work)](const ExecutionContext& context) {
    const std::shared_ptr<const Snapshot> now = snapshot();
    work(*now, context);
  });
}

void SolverSession::Cancel() {
  const std::lock_guard lock(mutex_);
  tasks_.clear();
  if (running_) {
    running_->Cancel();
    status_.cancelling = true;
  } else {
    status_.busy = false;
  }
}

void SolverSession::Enqueue(const std::string& phase, Task task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.emplace_back(phase, std::move(task));
    status_.busy = true;
    status_.message.clear();
  }
  wake_.notify_all();
}

void SolverSession::Work() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
    if (stopping_) return;
    const auto [phase, task] = std::move(tasks_.front());
    tasks_.pop_front();
    status_.phase = phase;
    status_.fraction = 0;
    running_ = std::make_shared<ExecutionContext>([this](std::string_view name, double fraction) {
      const std::lock_guard inner(mutex_);
      status_.phase = name;
      status_.fraction = fraction;
    });
    const std::shared_ptr<ExecutionContext> context = running_;
    lock.unlock();
    std::string message;
    try {
      task(*context);
    } catch (const InputError& error) {
      message = error.what();
    } catch (const std::bad_alloc&) {
      message = "out of memory; ask for a larger error or a larger min-area";
    }
    lock.lock();
    running_.reset();
    if (!message.empty()) status_.message = message;
    status_.cancelling = false;
    status_.busy = !tasks_.empty();
    if (!status_.busy) status_.phase.clear();
  }
}

void SolverSession::Publish(std::shared_ptr<Snapshot> next) {
  const std::lock_guard lock(mutex_);
  next->number = snapshot_->number + 1;
  snapshot_ = std::move(next);
}

void SolverSession::Restart(std::shared_ptr<const Scene> scene) {
  pipeline_.reset();
  visibility_.reset();
  Publish(DarkSnapshot(std::move(scene)));
}

// A copy of the solver's state goes out, with its leaves as a mesh; meshes of earlier states are dropped.
void SolverSession::PublishLight(std::size_t corrections) {
  const std::shared_ptr<const Snapshot> before = snapshot();
  auto next = std::make_shared<Snapshot>(*before);
  next->mesh = {};
  next->measured.reset();
  next->light =
      std::make_shared<const LightState>(before->scene, visibility_, pipeline_->solution(), options().point);
  const RadiositySolution& solution = next->light->solution();
  next->mesh[static_cast<std::size_t>(MeshKind::kFlat)] =
      std::make_shared<const MeshState>(before->scene, LeafMesh(solution.forest, solution.irradiance));
  next->corrections = corrections;
  next->converged = pipeline_->Converged();
  next->iterations = pipeline_->report().iterations;
  Publish(std::move(next));
}

void SolverSession::DoLink(const ExecutionContext& context) {
  context.Report("link", 0);
  PipelineOptions options;
  {
    const std::lock_guard lock(mutex_);
    options = options_;
    stale_links_ = false;
  }
  const std::shared_ptr<const Snapshot> before = snapshot();
  auto pipeline = std::make_unique<Pipeline>(*before->scene, options);
  pipeline->Link(context);
  if (context.Cancelled()) return;
  pipeline_ = std::move(pipeline);
  visibility_ = std::make_shared<const PatchVisibility>(pipeline_->visibility());
  PublishLight(0);
}

bool SolverSession::MustLink() const {
  const std::lock_guard lock(mutex_);
  return !pipeline_ || stale_links_;
}

void SolverSession::DoIterate(const ExecutionContext& context) {
  if (MustLink()) DoLink(context);
  if (!pipeline_ || context.Cancelled()) return;
  context.Report("iterate", 0);
  const std::optional<IterationReport> report = pipeline_->Iterate(context);
  if (report) PublishLight(report->links_split > 0 ? 0 : snapshot()->corrections);
}

void SolverSession::DoConverge(const ExecutionContext& context) {
  const int most = options().max_iterations;
  for (int i = 0; i < most && !context.Cancelled(); ++i) {
    if (!MustLink() && pipeline_->Converged()) break;
    DoIterate(context);
  }
  if (!context.Cancelled()) DoCorrect(context);
}

void SolverSession::DoCorrect(const ExecutionContext& context) {
  if (!pipeline_) DoIterate(context);
  if (!pipeline_ || context.Cancelled()) return;
  context.Report("correct", 0);
  if (pipeline_->Correct(context)) PublishLight(snapshot()->corrections + 1);
}

void SolverSession::DoBuildMesh(MeshKind kind, const ExecutionContext& context) {
  const std::shared_ptr<const Snapshot> before = snapshot();
  if (!before->light || before->Mesh(kind)) return;
  const ResolvedOptions resolved = Resolve(*before->scene, options());
  MeshOptions mesh;
  mesh.discontinuities = resolved.discontinuities;
  if (kind != MeshKind::kGouraudMesh && kind != MeshKind::kInterpolant)
    mesh.discontinuities.choice = DiscontinuityChoice::kNone;
  mesh.order = kind == MeshKind::kInterpolant ? InterpolantOrder::kQuadratic : InterpolantOrder::kLinear;
  MeshResult result = RunLocalPass(before->light->visibility(), before->light->solution(),
                                   SamplerOf(*before->light), mesh, context);
  if (context.Cancelled()) return;
  auto next = std::make_shared<Snapshot>(*before);
  next->mesh[static_cast<std::size_t>(kind)] =
      std::make_shared<const MeshState>(before->scene, std::move(result.mesh));
  Publish(std::move(next));
}

void SolverSession::DoMeasure(const ExecutionContext& context) {
  DoBuildMesh(MeshKind::kInterpolant, context);
  const std::shared_ptr<const Snapshot> before = snapshot();
  if (!before->Mesh(MeshKind::kInterpolant) || context.Cancelled()) return;
  context.Report("measure", 0);
  const PipelineOptions options = this->options();
  const RadiositySolution& solution = before->light->solution();
  const IrradianceMesh& mesh = before->Mesh(MeshKind::kInterpolant)->mesh();
  const IrradianceSampler sampler = SamplerOf(*before->light);
  PipelineReport report;
  report.energy = MeasureEnergy(solution);
  report.interpolant_error =
      MeasureRepresentationError(*before->scene, mesh, sampler, options.error_points, options.seed);
  report.solution_error_estimate =
      EstimateSolutionError(solution, before->light->Exact(), options.error_points, options.seed) +
      EstimateSourceError(solution, mesh, sampler, options.error_points, options.seed);
  report.error_asked = options.error;
  report.error_met = report.interpolant_error.p99 + report.solution_error_estimate <= options.error;
  auto next = std::make_shared<Snapshot>(*before);
  next->measured = std::move(report);
  Publish(std::move(next));
}

}  // namespace penumbra::viewer
