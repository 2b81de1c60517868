// display/viewer/solver_session.h
//
// A SolverSession runs the steps of the solver and the construction of meshes in a separate thread, so that
// the window never waits for the solver.

#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "display/viewer/light_change.h"
#include "display/viewer/opened_scene.h"
#include "display/viewer/session_progress.h"
#include "display/viewer/snapshot.h"
#include "display/viewer/solver_place.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

struct SessionStatus {
  bool busy = false;
  bool cancelling = false;
  std::string phase;           // the name of the task that is running
  double fraction = 0;         // the completed fraction of all tasks, in [0, 1), which never decreases
  std::string text;            // a description of the running task: the stage, its round, the error so far
  double seconds = 0;          // the time since the session began to work [s]
  double unsaved_seconds = 0;  // the computing time in the present state that no file holds [s]
  std::string message;         // the message of the last error; empty if there was none
};

// Any thread may call the functions of SolverSession, except the destructor; all functions return without
// waiting for the solver. The session's tasks, such as Iterate() and BuildMesh(), run one after another, in
// the order of the calls.
class SolverSession {
 public:
  // If `opened` contains a solution, the options of this solution are used instead of `options`.
  SolverSession(const OpenedScene& opened, const PipelineOptions& options);
  // Cancels all tasks of the session, and waits for the end of the running step.
  ~SolverSession();
  SolverSession(const SolverSession&) = delete;
  SolverSession& operator=(const SolverSession&) = delete;

  // The latest state of the solution; never null. The state contains only complete steps of the solver.
  std::shared_ptr<const Snapshot> snapshot() const;
  SessionStatus status() const;

  // Continues the session with another scene or solution. If OpenedScene::restart is set, the links of
  // `restart` are used, and the tasks Link() and Iterate() only compute the light over these links. With
  // OpenedScene::restart, the link options (IsLinkOption) must equal the options by which the links of
  // `restart` were made.
  void SetScene(const OpenedScene& opened);
  // Sets the options of later tasks. If an option that affects links (IsLinkOption) changes, the next
  // iteration makes new links and starts from the beginning.
  void SetOptions(const PipelineOptions& options);
  // Sets the number of points for later measurements of errors (PipelineOptions::error_points). A change of
  // the error points invalidates only earlier measurements.
  void SetErrorPoints(std::size_t points);
  PipelineOptions options() const;

  void Link();      // starts to make links between elements, from the beginning
  void Iterate();   // starts an iteration; makes links first if there are none
  void Converge();  // starts iterations until convergence, then deferred corrections
  void Correct();   // starts a deferred correction by exact irradiance
  // Makes the next of the smallest steps: links, one sweep, one level of splitting, the corrections, the
  // first interpolants, the refinement of light, that of the mesh. No effect once the snapshot is complete.
  void Step();
  // Lights the scene with other lamps and reflectances, over the transport that is kept of the solution: no
  // form factor is computed. Builds the interpolants, and keeps the transport, at the first call. A call
  // replaces a waiting one. A call with the present light makes ready for others.
  void SetLight(const LightChange& change);

  // The present state, and the way back to it. Return() ends what is running.
  std::shared_ptr<const SolverPlace> place() const;
  void Return(std::shared_ptr<const SolverPlace> place);
  // The steps since the scene was opened, the oldest first. The present state is that after the first
  // place()->step of them: a step replaces those that follow it. Places of the oldest are dropped where they
  // need much memory.
  std::shared_ptr<const std::vector<StepRecord>> steps() const;
  // Builds the mesh for a display mode, from the state at the start of the task. If the solver has converged
  // and `kind` is kInterpolant, the light is refined first (Pipeline::RefineLight), and the snapshot shows
  // the refined light.
  void BuildMesh(MeshKind kind);
  // Measures the energy balance and the errors of the irradiance interpolants. Measure() builds the
  // interpolants if necessary. For a solution from a file, Measure() keeps the measurements that the file
  // contains.
  void Measure();
  // Runs Measure(), then calls write(pipeline) to save the solution.
  void Save(std::function<void(const Pipeline&)> write);
  // Runs another long task `work` that reads the latest Snapshot, for example to make a picture. If `work`
  // throws InputError, the text of the error becomes SessionStatus::message.
  void Run(const std::string& phase,
           std::function<void(const Snapshot&, const ExecutionContext& context)> work);

  // Cancels the running task, whose complete steps are kept, and removes all waiting tasks.
  void Cancel();

 private:
  using Task = std::function<void(const ExecutionContext&)>;

  void Work();
  void Hear(std::string_view phase, double fraction);
  void Begin(SolveStage stage);
  bool MustLink() const;
  bool Converged() const;
  bool IsLit() const;
  void Own();
  void Enqueue(const std::string& phase, Task task, bool replaces = false);
  void DoLink(const ExecutionContext& context);
  void DoIterate(const ExecutionContext& context);
  void DoConverge(const ExecutionContext& context);
  void DoCorrect(const ExecutionContext& context);
  void DoBuildMesh(MeshKind kind, const ExecutionContext& context);
  void DoInterpolants(const ExecutionContext& context);
  void DoMeasure(const ExecutionContext& context);
  void DoLoad(const OpenedScene& opened);
  void DoFirstGather(const ExecutionContext& context);
  void DoStep(const ExecutionContext& context);
  void DoMeshStep(const ExecutionContext& context);
  void DoRefineLight(const ExecutionContext& context);
  void DoRefineMesh(const ExecutionContext& context);
  void DoSave(const std::function<void(const Pipeline&)>& write, const ExecutionContext& context);
  void DoReturn(const SolverPlace& place);
  // session_light.cpp
  void DoLight(const LightChange& change, const ExecutionContext& context);
  std::optional<EmitterLight> SumOfLamps(const LightChange& change);
  void PublishLit(std::shared_ptr<const Scene> scene, const EmitterLight& light);
  std::optional<PipelineState> LitState() const;

  std::shared_ptr<Snapshot> NextLight(std::size_t corrections) const;
  void PublishLight(std::size_t corrections, const std::string& step);
  // `step`: the name of a record; empty: no step of the solver.
  void Publish(std::shared_ptr<Snapshot> next, const std::string& step = "");
  void Record(const std::string& step, const Snapshot& before);
  Pipeline& pipeline() const { return *held_->pipeline; }

  mutable std::mutex mutex_;  // protects the following members, which several threads use
  std::condition_variable wake_;
  std::deque<std::pair<std::string, Task>> tasks_;
  std::shared_ptr<const Snapshot> snapshot_;
  SessionStatus status_;
  PipelineOptions options_;
  std::shared_ptr<ExecutionContext> running_;
  bool stopping_ = false;
  std::shared_ptr<const SolverPlace> place_;
  std::shared_ptr<const std::vector<StepRecord>> steps_ = std::make_shared<std::vector<StepRecord>>();
  SessionProgress progress_;
  std::chrono::steady_clock::time_point working_since_;

  // Only the solver's thread uses the following members.
  std::chrono::steady_clock::time_point step_since_,
      record_since_;                    // the times of the last Publish() and of the last Record()
  std::shared_ptr<HeldPipeline> held_;  // null until the solver has made links between elements
  // The solution whose links transport the light; null if the scene has its own links.
  std::shared_ptr<const PipelineState> restart_;
  // The scene as the user opened it, before lamps or materials were changed.
  std::shared_ptr<const Scene> opened_;
  // How the light of the snapshot's scene differs from that of the opened scene.
  LightChange change_;
  std::size_t step_ = 0;        // the number of step records that led to the present state
  std::uint64_t openings_ = 0;  // the number of scenes that were opened after the first
  // The snapshot with the light of held_'s own scene, while lamps or materials are changed.
  std::shared_ptr<const Snapshot> unlit_;
  // The light of each lamp alone over the kept transport, in the order of LampsOf(held_->scene); empty: not
  // computed.
  std::vector<EmitterLight> lamps_;
  const HeldPipeline* lamps_of_ = nullptr;
  std::uint64_t lamps_at_ = 0;  // the value of HeldPipeline::changes for which light by emitter is known

  std::thread thread_;
};

}  // namespace penumbra::viewer
