// display/viewer/solver_session.h
//
// Runs the steps of the solver and of the mesh in a separate thread, so that the window never waits for the
// solver.

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "display/viewer/opened_scene.h"
#include "display/viewer/snapshot.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

struct SessionStatus {
  bool busy = false;
  bool cancelling = false;
  std::string phase;    // the present task
  double fraction = 0;  // complete fraction of the phase, in [0, 1]
  std::string message;  // the last error; empty: none
};

// All functions except the destructor may be called from any thread, and return without waiting for the
// solver. Tasks, such as Iterate() and BuildMesh(), run one after another, in the order of the calls.
class SolverSession {
 public:
  // If `opened` is a solution, its options are used instead of `options`.
  SolverSession(const OpenedScene& opened, const PipelineOptions& options);
  // Cancels all tasks, and waits for the end of the running step.
  ~SolverSession();
  SolverSession(const SolverSession&) = delete;
  SolverSession& operator=(const SolverSession&) = delete;

  // The latest state; never null. The state contains only complete steps.
  std::shared_ptr<const Snapshot> snapshot() const;
  SessionStatus status() const;

  // Continues with another scene or solution. If OpenedScene::restart is given, its links are used, and
  // linking and iterating only compute the light over these links; in this case, the link options
  // (IsLinkOption) must equal the options by which these links were made.
  void SetScene(const OpenedScene& opened);
  // Sets the options of later tasks. If a link option (IsLinkOption) changes, the next iteration starts from
  // the beginning.
  void SetOptions(const PipelineOptions& options);
  // Sets PipelineOptions::error_points for later measurements. All results other than measurements remain
  // valid.
  void SetErrorPoints(std::size_t points);
  PipelineOptions options() const;

  void Link();      // from the beginning
  void Iterate();   // links first if there are no links
  void Converge();  // iterates until convergence, then corrects
  void Correct();   // by exact irradiance
  // Builds the mesh for a display mode, from the state at the start of the task. If the solver has converged
  // and `kind` is kInterpolant, the light is refined first (Pipeline::RefineLight), and the snapshot shows
  // the refined light.
  void BuildMesh(MeshKind kind);
  // Measures the energy balance and the errors of the interpolants. Builds the interpolants if necessary. For
  // a solution from a file, the measurements in the file are kept.
  void Measure();
  // Runs Measure(), then `write`.
  void Save(std::function<void(const Pipeline&)> write);
  // Runs another long task that reads the latest snapshot, for example to make a picture. If the task throws
  // InputError, the text of the error becomes SessionStatus::message.
  void Run(const std::string& phase,
           std::function<void(const Snapshot&, const ExecutionContext& context)> work);

  // Ends the running task after its last complete step, and removes waiting tasks.
  void Cancel();

 private:
  using Task = std::function<void(const ExecutionContext&)>;

  void Work();
  bool MustLink() const;
  bool Converged() const;
  void Enqueue(const std::string& phase, Task task);
  void DoLink(const ExecutionContext& context);
  void DoIterate(const ExecutionContext& context);
  void DoConverge(const ExecutionContext& context);
  void DoCorrect(const ExecutionContext& context);
  void DoBuildMesh(MeshKind kind, const ExecutionContext& context);
  void DoInterpolants(const ExecutionContext& context);
  void DoMeasure(const ExecutionContext& context);
  void DoLoad(const OpenedScene& opened);
  std::shared_ptr<Snapshot> NextLight(std::size_t corrections) const;
  void PublishLight(std::size_t corrections);
  void Publish(std::shared_ptr<Snapshot> next);

  mutable std::mutex mutex_;  // guards the following members
  std::condition_variable wake_;
  std::deque<std::pair<std::string, Task>> tasks_;
  std::shared_ptr<const Snapshot> snapshot_;
  SessionStatus status_;
  PipelineOptions options_;
  std::shared_ptr<ExecutionContext> running_;
  bool stopping_ = false;
  bool stale_links_ = false;  // options changed after linking

  // Only the solver's thread uses the following members.
  std::shared_ptr<const PatchVisibility> visibility_;
  std::unique_ptr<Pipeline> pipeline_;
  std::shared_ptr<const PipelineState> restart_;  // its links transport the light; null: the scene's own
  bool settled_ = false;                          // the iterations have ended
  bool stored_ = false;  // pipeline_ shows the results from a file, from which it cannot continue

  std::thread thread_;
};

}  // namespace penumbra::viewer
