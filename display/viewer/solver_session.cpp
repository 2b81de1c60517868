#include "display/viewer/solver_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

#include "display/viewer/leaf_mesh.h"
#include "mesh/pipeline/option_table.h"
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
  next->begun = pipeline.report().begun;
  next->complete = false;
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

// Options that lead to other light or to another mesh, the same.
bool SameSolve(const PipelineOptions& a, const PipelineOptions& b) {
  for (const SolveOption& option : OptionTable())
    if (!option.measures_only && option.field.get(a) != option.field.get(b)) return false;
  return true;
}

double SecondsSince(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
}

// States of the time line hold so many bytes at most, and so many states: to go back farther is rarely worth
// memory that the solution could use.
constexpr std::size_t kMostBytesOfPlaces = std::size_t{1} << 29, kMostPlaces = 200;

std::shared_ptr<SolverPlace> FirstPlace(const std::shared_ptr<const Snapshot>& snapshot,
                                        const PipelineOptions& options) {
  auto place = std::make_shared<SolverPlace>();
  place->snapshot = snapshot;
  place->opened = snapshot->scene;
  place->options = options;
  return place;
}

}  // namespace

SolverSession::SolverSession(const OpenedScene& opened, const PipelineOptions& options)
    : snapshot_(DarkSnapshot(opened.scene)),
      options_(options),
      place_(FirstPlace(snapshot_, options)),
      opened_(opened.scene),
      thread_([this] { Work(); }) {
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
  SessionStatus status = status_;
  if (status.busy) status.seconds = SecondsSince(working_since_);
  status.unsaved_seconds = place_->unsaved_seconds;
  return status;
}

PipelineOptions SolverSession::options() const {
  const std::lock_guard lock(mutex_);
  return options_;
}

std::shared_ptr<const SolverPlace> SolverSession::place() const {
  const std::lock_guard lock(mutex_);
  return place_;
}

std::shared_ptr<const std::vector<StepRecord>> SolverSession::steps() const {
  const std::lock_guard lock(mutex_);
  return steps_;
}

void SolverSession::SetOptions(const PipelineOptions& options) {
  const std::lock_guard lock(mutex_);
  options_ = options;
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

void SolverSession::Step() {
  Enqueue("step", [this](const ExecutionContext& context) { DoStep(context); });
}

void SolverSession::BuildMesh(MeshKind kind) {
  Enqueue("mesh", [this, kind](const ExecutionContext& context) { DoBuildMesh(kind, context); });
}

void SolverSession::SetLight(const LightChange& change) {
  Enqueue(
      "light", [this, change](const ExecutionContext& context) { DoLight(change, context); },
      /*replaces=*/true);
}

void SolverSession::Measure() {
  Enqueue("measure", [this](const ExecutionContext& context) {
    DoMeasure(context);
    if (held_->stored && pipeline().options().error_points != options().error_points)
      throw InputError("a solution is measured when it is solved: iterate, to solve and measure it anew");
  });
}

void SolverSession::Save(std::function<void(const Pipeline&)> write) {
  Enqueue("save",
          [this, write = std::move(write)](const ExecutionContext& context) { DoSave(write, context); });
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

void SolverSession::Return(std::shared_ptr<const SolverPlace> place) {
  Cancel();
  Enqueue("return", [this, place = std::move(place)](const ExecutionContext&) { DoReturn(*place); });
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

void SolverSession::Enqueue(const std::string& phase, Task task, bool replaces) {
  {
    const std::lock_guard lock(mutex_);
    if (replaces && !tasks_.empty() && tasks_.back().first == phase) tasks_.pop_back();
    tasks_.emplace_back(phase, std::move(task));
    if (!status_.busy) working_since_ = std::chrono::steady_clock::now();
    status_.busy = true;
    status_.message.clear();
  }
  wake_.notify_all();
}

// What a running task reports, in words and as one number.
void SolverSession::Hear(std::string_view phase, double fraction) {
  const std::lock_guard lock(mutex_);
  status_.phase = phase;
  progress_.Report(phase, fraction);
  status_.fraction = progress_.fraction();
  std::string text(NameOf(progress_.stage()));
  if (text.empty() || text == phase) {
    text = phase;
  } else {
    if (progress_.turn() > 0) text += fmt::format(" {}", progress_.turn());
    text += fmt::format(": {}", phase);
  }
  if (!snapshot_->iterations.empty() && progress_.stage() <= SolveStage::kLight)
    text += fmt::format(", residual {:.1g}", snapshot_->iterations.back().residual);
  status_.text = std::move(text);
}

void SolverSession::Begin(SolveStage stage) {
  {
    const std::lock_guard lock(mutex_);
    progress_.Begin(stage);
  }
  Hear(NameOf(stage), 0);
}

void SolverSession::Work() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
    if (stopping_) return;
    const auto [phase, task] = std::move(tasks_.front());
    tasks_.pop_front();
    status_.phase = status_.text = phase;
    step_since_ = record_since_ = std::chrono::steady_clock::now();
    progress_.Begin(SolveStage::kOther);
    running_ = std::make_shared<ExecutionContext>(
        [this](std::string_view name, double fraction) { Hear(name, fraction); });
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
    if (!status_.busy) {
      status_.phase.clear();
      status_.text.clear();
      status_.fraction = 0;
    }
  }
}

void SolverSession::Publish(std::shared_ptr<Snapshot> next, const std::string& step) {
  const std::shared_ptr<const Snapshot> before = snapshot();
  auto place = std::make_shared<SolverPlace>();
  place->unlit = unlit_;
  place->held = held_;
  if (held_) place->changes = held_->changes;
  place->opened = opened_;
  place->restart = restart_;
  place->change = change_;
  if (!step.empty()) ++step_;
  place->step = step_;
  {
    const std::lock_guard lock(mutex_);
    next->number = snapshot_->number + 1;
    snapshot_ = std::move(next);
    place->snapshot = snapshot_;
    place->options = options_;
    place->unsaved_seconds = place_->unsaved_seconds + (snapshot_->light ? SecondsSince(step_since_) : 0);
    place_ = std::move(place);
  }
  if (!step.empty()) Record(step, *before);
  const std::lock_guard lock(mutex_);
  step_since_ = std::chrono::steady_clock::now();
}

// Adds a record of the step to the present state.
void SolverSession::Record(const std::string& step, const Snapshot& before) {
  StepRecord record;
  record.name = step;
  record.place = place();
  const Snapshot& now = *record.place->snapshot;
  record.seconds = SecondsSince(record_since_);
  record_since_ = std::chrono::steady_clock::now();
  if (now.begun)
    record.residual = now.begun->residual;
  else if (!now.iterations.empty())
    record.residual = now.iterations.back().residual;
  if (now.light && now.light != before.light) record.change = ChangeOfLight(before.light.get(), *now.light);
  if (now.light) {
    record.links = now.light->solution().links.links.size();
    for (const Element& element : now.light->solution().forest.elements())
      record.leaves += element.IsLeaf() ? 1 : 0;
  }
  if (now.measured) record.error = now.measured->whole_error.p99;
  if (const auto& mesh = now.Mesh(MeshKind::kInterpolant)) record.triangles = mesh->mesh().triangles.size();
  auto steps = std::make_shared<std::vector<StepRecord>>(*this->steps());
  steps->resize(std::min(steps->size(),
                         step_ - 1));  // what was gone back over is made anew
  step_ = steps->size() + 1;
  steps->push_back(std::move(record));
  std::size_t bytes = 0, places = 0;
  for (auto old = steps->rbegin(); old != steps->rend(); ++old) {
    if (!old->place) break;
    bytes += BytesOf(*old->place);
    ++places;
    if (places > 1 && (bytes > kMostBytesOfPlaces || places > kMostPlaces)) old->place.reset();
  }
  const std::lock_guard lock(mutex_);
  steps_ = std::move(steps);
}

void SolverSession::DoLoad(const OpenedScene& opened) {
  Begin(SolveStage::kLoad);
  held_.reset();
  unlit_.reset();
  change_ = {};
  const bool other = opened.scene != opened_;
  opened_ = opened.scene;
  restart_ = opened.restart;
  step_ = 0;
  const std::shared_ptr<Snapshot> dark = DarkSnapshot(opened.scene);
  dark->opening = other ? ++openings_ : snapshot()->opening;
  {
    const std::lock_guard lock(mutex_);
    steps_ = std::make_shared<std::vector<StepRecord>>();
    if (opened.stored) options_ = opened.solving;
  }
  if (!opened.stored) {
    Publish(dark);
  } else {
    held_ = std::make_shared<HeldPipeline>();
    held_->scene = opened.scene;
    // A copy: another place may come back to the file's state.
    held_->pipeline =
        std::make_unique<Pipeline>(*opened.scene, opened.solving, PipelineState(*opened.stored));
    held_->visibility = std::make_shared<const PatchVisibility>(pipeline().visibility());
    held_->made_with = opened.solving;
    held_->settled = held_->stored = true;
    const std::shared_ptr<Snapshot> next = LightOf(pipeline(), *dark, held_->visibility);
    next->mesh[static_cast<std::size_t>(*pipeline().mesh_kind())] =
        std::make_shared<const MeshState>(opened.scene, pipeline().mesh());
    next->converged = next->complete = true;
    next->measured = pipeline().report();
    Publish(next, "open");
  }
  const std::lock_guard lock(mutex_);
  auto place = std::make_shared<SolverPlace>(*place_);
  place->unsaved_seconds = 0;
  place_ = std::move(place);
}

// The solver's state now, with its leaves as a mesh; meshes of earlier states are dropped.
std::shared_ptr<Snapshot> SolverSession::NextLight(std::size_t corrections) const {
  std::shared_ptr<Snapshot> next = LightOf(pipeline(), *snapshot(), held_->visibility);
  next->corrections = corrections;
  next->converged = Converged();
  return next;
}

// Links that were given are not judged: over them the light has to settle, and that is all.
bool SolverSession::Converged() const {
  if (!restart_) return pipeline().Converged();
  return pipeline().report().iterations.back().residual <= pipeline().resolved().solver.relative_cutoff;
}

// True if the snapshot has the light of another scene than the pipeline's.
bool SolverSession::IsLit() const { return unlit_ != nullptr; }

void SolverSession::PublishLight(std::size_t corrections, const std::string& step) {
  ++held_->changes;
  Publish(NextLight(corrections), step);
}

// Lets what comes next change a pipeline that no other place refers to, if the method has copies. Other
// places show what they were, and begin anew.
void SolverSession::Own() {
  if (!held_ || held_->stored) return;
  {
    const std::lock_guard lock(mutex_);
    constexpr long kOwn = 2;  // references: this session's, and that of its present place
    if (held_.use_count() <= kOwn && place_.use_count() == 1) return;
  }
  std::unique_ptr<Pipeline> branch = pipeline().Branch();
  if (!branch) return;
  auto own = std::make_shared<HeldPipeline>();
  own->scene = held_->scene;
  own->pipeline = std::move(branch);
  own->visibility = held_->visibility;
  own->made_with = held_->made_with;
  own->scene_change = held_->scene_change;
  own->settled = held_->settled;
  held_ = std::move(own);
}

void SolverSession::DoLink(const ExecutionContext& context) {
  Begin(restart_ ? SolveStage::kIterate : SolveStage::kLink);
  const PipelineOptions options = this->options();
  const std::shared_ptr<const Snapshot> before = snapshot();
  auto made = std::make_shared<HeldPipeline>();
  made->scene = before->scene;
  made->made_with = options;
  made->scene_change = change_;
  if (restart_) {
    made->pipeline = std::make_unique<Pipeline>(*before->scene, options, PipelineState(*restart_));
    made->pipeline->Relight(context);
  } else {
    made->pipeline = std::make_unique<Pipeline>(*before->scene, options);
    made->pipeline->Link(context);
  }
  if (context.Cancelled()) return;
  made->settled = !restart_ && !made->pipeline->NextStep();
  made->visibility = std::make_shared<const PatchVisibility>(made->pipeline->visibility());
  held_ = std::move(made);
  unlit_.reset();
  PublishLight(0, "link");
}

// Light at once: one sweep over the first links, by a solver of its own, for the present one must go on as it
// does without a window.
void SolverSession::DoFirstGather(const ExecutionContext& context) {
  if (context.Cancelled() || pipeline().NextSmallStep() != SolverStep::kSweep) return;
  const std::unique_ptr<Pipeline> first = pipeline().Branch();
  if (!first || !first->Step(SolverStep::kSweep, context)) return;
  Publish(LightOf(*first, *snapshot(), held_->visibility));
}

bool SolverSession::MustLink() const {
  return !held_ || held_->stored || IsLit() || !SameSolve(held_->made_with, options());
}

void SolverSession::DoIterate(const ExecutionContext& context) {
  if (MustLink()) DoLink(context);
  // Links that were given are lit with the first step.
  if (!held_ || context.Cancelled() || restart_) return;
  Begin(SolveStage::kIterate);
  Own();
  const std::optional<IterationReport> report = pipeline().Iterate(context);
  if (!report) return;
  held_->settled = pipeline().Converged();
  PublishLight(report->links_split > 0 ? 0 : snapshot()->corrections, "iterate");
}

void SolverSession::DoConverge(const ExecutionContext& outer) {
  const PipelineOptions options = this->options();
  const RunLimits limits(outer, options.time_limit, options.memory_limit);
  const ExecutionContext& context = limits.context();
  const bool must_link = MustLink();
  if (!must_link && held_->settled && snapshot()->corrections > 0) return;  // done is done
  if (must_link) DoLink(context);
  if (!context.Cancelled() && restart_) DoCorrect(context);
  if (!context.Cancelled() && !restart_) {
    if (must_link) DoFirstGather(context);
    Begin(SolveStage::kIterate);
    Own();
    pipeline().Solve(context, [this](SolverStep step) {
      if (step == SolverStep::kCorrect) return PublishLight(snapshot()->corrections + 1, "correct");
      const bool links_split = pipeline().report().iterations.back().links_split > 0;
      PublishLight(links_split ? 0 : snapshot()->corrections, "iterate");
    });
  }
  if (!outer.Cancelled() && held_) held_->settled = true;
  // The solve watches the same limits, and keeps a part of the memory for what follows.
  std::string message = held_ ? EndOfSolve(pipeline().report()) : "";
  if (const std::optional<std::string> limit = limits.Exceeded(); limit && context.Cancelled())
    message = "ended by " + *limit;
  if (outer.Cancelled() || message.empty()) return;
  const std::lock_guard lock(mutex_);
  status_.message = message;
}

void SolverSession::DoCorrect(const ExecutionContext& context) {
  if (MustLink()) DoIterate(context);
  if (!held_ || context.Cancelled()) return;
  Begin(SolveStage::kCorrect);
  Own();
  if (pipeline().Correct(context)) PublishLight(snapshot()->corrections + 1, "correct");
}

void SolverSession::DoStep(const ExecutionContext& context) {
  if (MustLink()) return DoLink(context);
  const std::optional<SolverStep> next = restart_ ? std::nullopt : pipeline().NextSmallStep();
  if (!next) return DoMeshStep(context);
  Begin(*next == SolverStep::kCorrect ? SolveStage::kCorrect : SolveStage::kIterate);
  Own();
  const std::size_t links = pipeline().solution().links.links.size();
  if (!pipeline().Step(*next, context)) return;
  const bool corrects = *next == SolverStep::kCorrect;
  const bool splits = pipeline().solution().links.links.size() != links;
  PublishLight(splits ? 0 : snapshot()->corrections + (corrects ? 1 : 0), std::string(StepName(*next)));
}

// The steps after the solver's: the first interpolants, light, and mesh.
void SolverSession::DoMeshStep(const ExecutionContext& context) {
  const std::shared_ptr<const Snapshot> now = snapshot();
  if (now->complete) return;
  held_->settled = true;
  const bool first = !pipeline().mesh_kind();
  if (first && !now->Mesh(MeshKind::kInterpolant)) {
    Begin(SolveStage::kMesh);
    pipeline().BuildMesh(MeshKind::kInterpolant, context, /*as_it_is=*/true);
    if (context.Cancelled()) return;
    auto next = std::make_shared<Snapshot>(*now);
    next->mesh[static_cast<std::size_t>(*pipeline().mesh_kind())] =
        std::make_shared<const MeshState>(held_->scene, pipeline().mesh());
    return Publish(std::move(next), "first interpolants");
  }
  if (!pipeline().LightIsRefined() && pipeline().RefinesLight()) return DoRefineLight(context);
  DoRefineMesh(context);
}

void SolverSession::DoBuildMesh(MeshKind kind, const ExecutionContext& context) {
  const std::shared_ptr<const Snapshot> before = snapshot();
  if (!before->light) return;
  if (kind == MeshKind::kInterpolant) return DoInterpolants(context);
  if (before->Mesh(kind)) return;
  Begin(SolveStage::kMesh);
  MeshOptions mesh;
  mesh.discontinuities = before->light->discontinuities();
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

// Refines the light of a solver that has settled; the meshes on the way are shown.
void SolverSession::DoRefineLight(const ExecutionContext& context) {
  Begin(SolveStage::kLight);
  Own();
  const std::shared_ptr<const Snapshot> before = snapshot();
  pipeline().ObserveMesh([this](const IrradianceMesh& mesh) {
    const auto next = std::make_shared<Snapshot>(*snapshot());
    next->mesh[static_cast<std::size_t>(MeshKind::kInterpolant)] =
        std::make_shared<const MeshState>(held_->scene, mesh);
    Publish(next);
  });
  pipeline().RefineLight(context);
  pipeline().ObserveMesh({});
  if (context.Cancelled()) return;
  ++held_->changes;
  const std::shared_ptr<Snapshot> refined = NextLight(before->corrections);
  refined->converged = before->converged;
  // The latest mesh on the way stays in view until the next.
  refined->mesh[static_cast<std::size_t>(MeshKind::kInterpolant)] = snapshot()->Mesh(MeshKind::kInterpolant);
  Publish(refined, "refine light");
}

void SolverSession::DoRefineMesh(const ExecutionContext& context) {
  Begin(SolveStage::kMesh);
  const std::shared_ptr<const Snapshot> before = snapshot();
  pipeline().ObserveMesh([this](const IrradianceMesh& mesh) {
    const auto next = std::make_shared<Snapshot>(*snapshot());
    next->mesh[static_cast<std::size_t>(MeshKind::kInterpolant)] =
        std::make_shared<const MeshState>(held_->scene, mesh);
    Publish(next, held_->settled ? "refine mesh" : "");
  });
  pipeline().BuildMesh(MeshKind::kInterpolant, context,
                       /*as_it_is=*/!held_->settled);
  pipeline().ObserveMesh({});
  if (context.Cancelled()) return;
  const auto next = std::make_shared<Snapshot>(*snapshot());
  // Where a limit ended it, the leaves.
  const MeshKind made = *pipeline().mesh_kind();
  next->mesh[static_cast<std::size_t>(MeshKind::kInterpolant)].reset();
  next->mesh[static_cast<std::size_t>(made)] =
      std::make_shared<const MeshState>(held_->scene, pipeline().mesh());
  next->complete = held_->settled;
  Publish(next, held_->settled ? "interpolants" : "");
}

// The pipeline's own: once the solver has settled, its light is refined and shown before they are. What was
// stepped to stays as it is. A limit of time is one for the solve, and one for these.
void SolverSession::DoInterpolants(const ExecutionContext& context) {
  const std::shared_ptr<const Snapshot> before = snapshot();
  if (!held_ || IsLit()) return;
  const bool as_it_is = !held_->settled || held_->stored;
  if (before->Mesh(MeshKind::kInterpolant) && pipeline().mesh_kind() && (as_it_is || before->complete))
    return;
  pipeline().CountLimits();
  if (held_->settled && pipeline().RefinesLight() && !pipeline().LightIsRefined()) DoRefineLight(context);
  if (!context.Cancelled()) DoRefineMesh(context);
}

void SolverSession::DoMeasure(const ExecutionContext& context) {
  if (!held_) throw InputError("nothing is solved yet: iterate first");
  if (IsLit())
    throw InputError("the light of dimmed or painted scenes is not measured: iterate, to solve it anew");
  // What a file brought was measured when it was solved.
  const std::size_t points = held_->stored ? pipeline().options().error_points : options().error_points;
  if (snapshot()->measured && pipeline().options().error_points == points) return;
  if (held_->stored)
    throw InputError("what is shown as of a file is not measured: iterate, to solve and measure it anew");
  DoInterpolants(context);
  if (context.Cancelled()) return;
  Begin(SolveStage::kMeasure);
  pipeline().SetErrorPoints(points);
  pipeline().Measure(context);
  if (context.Cancelled()) return;
  auto next = std::make_shared<Snapshot>(*snapshot());
  next->measured = pipeline().report();
  Publish(std::move(next), "measure");
}

void SolverSession::DoSave(const std::function<void(const Pipeline&)>& write,
                           const ExecutionContext& context) {
  const bool unmeasured = held_ && (IsLit() || (held_->stored && !snapshot()->measured));
  if (unmeasured) {
    DoInterpolants(context);
    if (context.Cancelled()) return;
    if (!snapshot()->Mesh(MeshKind::kInterpolant)) throw InputError("there are no interpolants to save");
    std::optional<PipelineState> state = LitState();
    PENUMBRA_CHECK(state.has_value());
    Pipeline lit(*snapshot()->scene, pipeline().options(), std::move(*state));
    lit.Diagnose(context);
    if (!context.Cancelled()) write(lit);
  } else {
    DoMeasure(context);
    if (context.Cancelled()) return;
    context.Report("save", 0);
    if (held_->stored) pipeline().Diagnose();  // what files leave out of reports
    write(pipeline());
  }
  const std::lock_guard lock(mutex_);
  auto place = std::make_shared<SolverPlace>(*place_);
  place->unsaved_seconds = 0;
  place_ = std::move(place);
}

void SolverSession::DoReturn(const SolverPlace& place) {
  {
    const std::lock_guard lock(mutex_);
    options_ = place.options;
  }
  opened_ = place.opened;
  restart_ = place.restart;
  change_ = place.change;
  unlit_ = place.unlit;
  held_ = place.held;
  step_ = std::min(place.step, steps()->size());
  auto next = std::make_shared<Snapshot>(*place.snapshot);
  if (held_ && held_->changes != place.changes) {
    // The pipeline has gone on, for its method has no copies: what it showed is shown as of a file.
    const std::shared_ptr<const Snapshot>& own = unlit_ ? unlit_ : place.snapshot;
    PipelineState state;
    state.visibility = *held_->visibility;
    state.solution = own->light->solution();
    const auto& mesh = own->Mesh(MeshKind::kInterpolant);
    state.mesh_kind = mesh ? MeshKind::kInterpolant : MeshKind::kFlat;
    state.mesh = own->Mesh(state.mesh_kind)->mesh();
    state.report.iterations = own->iterations;
    state.report.error_asked = place.options.error;
    if (own->measured) state.report = *own->measured;
    auto shown = std::make_shared<HeldPipeline>();
    shown->scene = held_->scene;
    shown->made_with = held_->made_with;
    shown->scene_change = held_->scene_change;
    shown->pipeline = std::make_unique<Pipeline>(*shown->scene, held_->made_with, std::move(state));
    shown->visibility = held_->visibility;
    shown->settled = shown->stored = true;
    held_ = std::move(shown);
  }
  Publish(std::move(next));
  const std::lock_guard lock(mutex_);
  auto now = std::make_shared<SolverPlace>(*place_);
  now->unsaved_seconds = place.unsaved_seconds;
  place_ = std::move(now);
}

}  // namespace penumbra::viewer
