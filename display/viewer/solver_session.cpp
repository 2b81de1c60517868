#include "display/viewer/solver_session.h"

#include <new>
#include <utility>

#include "display/viewer/leaf_mesh.h"
#include "mesh/pipeline/run_limits.h"
#include "mesh/refinement/local_pass.h"
#include "solver/base/check.h"

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

// What a snapshot of the scene becomes with the pipeline's light.
std::shared_ptr<Snapshot> LightOf(const Pipeline& pipeline, const Snapshot& before,
                                  std::shared_ptr<const PatchVisibility> visibility) {
  auto next = std::make_shared<Snapshot>(before);
  next->mesh = {};
  next->measured.reset();
  next->light =
      std::make_shared<const LightState>(before.scene, std::move(visibility), pipeline.solution(),
                                         pipeline.options().point, pipeline.resolved().discontinuities);
  const RadiositySolution& solution = next->light->solution();
  next->mesh[static_cast<std::size_t>(MeshKind::kFlat)] =
      std::make_shared<const MeshState>(before.scene, LeafMesh(solution.forest, solution.irradiance));
  next->iterations = pipeline.report().iterations;
  return next;
}

// What ended the links or the iterations before their end; empty if nothing did.
std::string EndOfSolve(const PipelineReport& report) {
  for (const std::string& line : report.unmet)
    if ((line.starts_with("link: ") || line.starts_with("iterate: ")) &&
        line.find("ended by") != std::string::npos)
      return line;
  return "";
}

}  // namespace

SolverSession::SolverSession(const OpenedScene& opened, const PipelineOptions& options)
    : snapshot_(DarkSnapshot(opened.scene)), options_(options), thread_([this] { Work(); }) {
  if (opened.stored || opened.restart) SetScene(opened);
}

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

void SolverSession::SetErrorPoints(std::size_t points) {
  const std::lock_guard lock(mutex_);
  options_.error_points = points;
}

void SolverSession::SetScene(const OpenedScene& opened) {
  Cancel();
  Enqueue("load", [this, opened](const ExecutionContext&) { DoLoad(opened); });
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
  Enqueue("measure", [this](const ExecutionContext& context) {
    DoMeasure(context);
    if (stored_ && pipeline_->options().error_points != options().error_points)
      throw InputError("a solution is measured when it is solved: iterate, to solve and measure it anew");
  });
}

void SolverSession::Save(std::function<void(const Pipeline&)> write) {
  Enqueue("save", [this, write = std::move(write)](const ExecutionContext& context) {
    DoMeasure(context);
    if (context.Cancelled()) return;
    context.Report("save", 0);
    if (stored_) pipeline_->Diagnose();  // what files leave out of reports
    write(*pipeline_);
  });
}

void SolverSession::Run(const std::string& phase,
                        std::function<void(const Snapshot&, const ExecutionContext&)> work) {
  Enqueue(phase, [this, work = std::move(work)](const ExecutionContext& context) {
    const std::shared_ptr<const Snapshot> now = snapshot();
    try {
      work(*now, context);
    } catch (const std::bad_alloc&) {  // which says nothing of the solution
      throw InputError("out of memory; ask for a smaller picture or less supersampling");
    }
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

void SolverSession::DoLoad(const OpenedScene& opened) {
  pipeline_.reset();
  visibility_.reset();
  settled_ = stored_ = opened.stored != nullptr;
  restart_ = opened.restart;
  const std::shared_ptr<Snapshot> dark = DarkSnapshot(opened.scene);
  if (!opened.stored) {
    Publish(dark);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    options_ = opened.solving;
  }
  pipeline_ = std::make_unique<Pipeline>(*opened.scene, opened.solving, std::move(*opened.stored));
  visibility_ = std::make_shared<const PatchVisibility>(pipeline_->visibility());
  const std::shared_ptr<Snapshot> next = LightOf(*pipeline_, *dark, visibility_);
  next->mesh[static_cast<std::size_t>(*pipeline_->mesh_kind())] =
      std::make_shared<const MeshState>(opened.scene, pipeline_->mesh());
  next->converged = true;
  next->measured = pipeline_->report();
  Publish(next);
}

// The solver's state now, with its leaves as a mesh; meshes of earlier states are dropped.
std::shared_ptr<Snapshot> SolverSession::NextLight(std::size_t corrections) const {
  std::shared_ptr<Snapshot> next = LightOf(*pipeline_, *snapshot(), visibility_);
  next->corrections = corrections;
  next->converged = Converged();
  return next;
}

// Links that were given are not judged: over them the light has to settle, and that is all.
bool SolverSession::Converged() const {
  if (!restart_) return pipeline_->Converged();
  return pipeline_->report().iterations.back().residual <= pipeline_->resolved().solver.relative_cutoff;
}

void SolverSession::PublishLight(std::size_t corrections) { Publish(NextLight(corrections)); }

void SolverSession::DoLink(const ExecutionContext& context) {
  context.Report(restart_ ? "iterate" : "link", 0);
  PipelineOptions options;
  {
    const std::lock_guard lock(mutex_);
    options = options_;
    stale_links_ = false;
  }
  const std::shared_ptr<const Snapshot> before = snapshot();
  std::unique_ptr<Pipeline> pipeline;
  if (restart_) {
    pipeline = std::make_unique<Pipeline>(*before->scene, options, PipelineState(*restart_));
    pipeline->Relight(context);
  } else {
    pipeline = std::make_unique<Pipeline>(*before->scene, options);
    pipeline->Link(context);
  }
  if (context.Cancelled()) return;
  pipeline_ = std::move(pipeline);
  stored_ = false;
  settled_ = !restart_ && !pipeline_->NextStep();
  visibility_ = std::make_shared<const PatchVisibility>(pipeline_->visibility());
  PublishLight(0);
}

bool SolverSession::MustLink() const {
  const std::lock_guard lock(mutex_);
  return !pipeline_ || stale_links_ || stored_;
}

void SolverSession::DoIterate(const ExecutionContext& context) {
  if (MustLink()) DoLink(context);
  // Links that were given are lit with the first step.
  if (!pipeline_ || context.Cancelled() || restart_) return;
  context.Report("iterate", 0);
  const std::optional<IterationReport> report = pipeline_->Iterate(context);
  if (!report) return;
  settled_ = pipeline_->Converged();
  PublishLight(report->links_split > 0 ? 0 : snapshot()->corrections);
}

void SolverSession::DoConverge(const ExecutionContext& outer) {
  const PipelineOptions options = this->options();
  const RunLimits limits(outer, options.time_limit, options.memory_limit);
  const ExecutionContext& context = limits.context();
  const bool must_link = MustLink();
  if (!must_link && settled_ && snapshot()->corrections > 0) return;  // done is done
  if (must_link) DoLink(context);
  if (!context.Cancelled() && restart_) DoCorrect(context);
  if (!context.Cancelled() && !restart_) {
    pipeline_->Solve(context, [this](SolverStep step) {
      if (step == SolverStep::kCorrect) return PublishLight(snapshot()->corrections + 1);
      const bool links_split = pipeline_->report().iterations.back().links_split > 0;
      PublishLight(links_split ? 0 : snapshot()->corrections);
    });
  }
  if (!outer.Cancelled()) settled_ = true;
  // The solve watches the same limits, and keeps a part of the memory for what follows.
  std::string message = pipeline_ ? EndOfSolve(pipeline_->report()) : "";
  if (const std::optional<std::string> limit = limits.Exceeded(); limit && context.Cancelled())
    message = "ended by " + *limit;
  if (outer.Cancelled() || message.empty()) return;
  const std::lock_guard lock(mutex_);
  status_.message = message;
}

void SolverSession::DoCorrect(const ExecutionContext& context) {
  if (MustLink()) DoIterate(context);
  if (!pipeline_ || context.Cancelled()) return;
  context.Report("correct", 0);
  if (pipeline_->Correct(context)) PublishLight(snapshot()->corrections + 1);
}

void SolverSession::DoBuildMesh(MeshKind kind, const ExecutionContext& context) {
  const std::shared_ptr<const Snapshot> before = snapshot();
  if (!before->light || before->Mesh(kind)) return;
  if (kind == MeshKind::kInterpolant) return DoInterpolants(context);
  MeshOptions mesh;
  mesh.discontinuities = pipeline_->resolved().discontinuities;
  if (kind != MeshKind::kGouraudMesh) mesh.discontinuities.choice = kNoDiscontinuities;
  mesh.order = InterpolantOrder::kLinear;
  MeshResult result = RunLocalPass(before->light->visibility(), before->light->solution(),
                                   SamplerOf(*before->light), mesh, context);
  if (context.Cancelled()) return;
  auto next = std::make_shared<Snapshot>(*before);
  next->mesh[static_cast<std::size_t>(kind)] =
      std::make_shared<const MeshState>(before->scene, std::move(result.mesh));
  Publish(std::move(next));
}

// The pipeline's own: once the solver has settled, its light is refined and shown before they are. What was
// stepped to stays as it is. A limit of time is one for the solve, and one for these.
void SolverSession::DoInterpolants(const ExecutionContext& context) {
  const std::shared_ptr<const Snapshot> before = snapshot();
  if (!pipeline_ || (before->Mesh(MeshKind::kInterpolant) && pipeline_->mesh_kind())) return;
  pipeline_->CountLimits();
  if (settled_ && pipeline_->RefinesLight()) {
    pipeline_->RefineLight(context);
    if (context.Cancelled()) return;
    const std::shared_ptr<Snapshot> refined = NextLight(before->corrections);
    refined->converged = before->converged;
    Publish(refined);
  }
  if (context.Cancelled()) return;
  pipeline_->BuildMesh(MeshKind::kInterpolant, context, /*as_it_is=*/!settled_);
  if (context.Cancelled()) return;
  const auto next = std::make_shared<Snapshot>(*snapshot());
  // Where a limit ended it, the leaves.
  next->mesh[static_cast<std::size_t>(*pipeline_->mesh_kind())] =
      std::make_shared<const MeshState>(before->scene, pipeline_->mesh());
  Publish(std::move(next));
}

void SolverSession::DoMeasure(const ExecutionContext& context) {
  if (!pipeline_) throw InputError("nothing is solved yet: iterate first");
  // What a file brought was measured when it was solved.
  const std::size_t points = stored_ ? pipeline_->options().error_points : options().error_points;
  if (snapshot()->measured && pipeline_->options().error_points == points) return;
  DoInterpolants(context);
  if (context.Cancelled()) return;
  pipeline_->SetErrorPoints(points);
  pipeline_->Measure(context);
  if (context.Cancelled()) return;
  auto next = std::make_shared<Snapshot>(*snapshot());
  next->measured = pipeline_->report();
  Publish(std::move(next));
}

}  // namespace penumbra::viewer
