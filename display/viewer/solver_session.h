// display/viewer/solver_session.h
//
// A SolverSession runs the steps of the solver and the construction of meshes in a separate thread, so that
// the window never waits for the solver.

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
  double fraction = 0;  // complete fraction of the present task, in [0, 1]
  std::string message;  // the last error message; empty if no error occurred
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

  void Link();      // discards the solution and makes links between the root elements
  void Iterate();   // makes one iteration of the solver; first makes links if the solution has none
  void Converge();  // iterates until the light has converged, then makes the deferred corrections
  void Correct();   // makes one deferred correction by exact irradiance
  // Builds a mesh of the given kind, from the state of the solution at the start of the task. If the solver
  // has converged and `kind` is kInterpolant, the light is refined first (Pipeline::RefineLight), and the
  // Snapshot shows the refined light.
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

  mutable std::mutex mutex_;  // protects the following members, which several threads use
  std::condition_variable wake_;
  std::deque<std::pair<std::string, Task>> tasks_;
  std::shared_ptr<const Snapshot> snapshot_;
  SessionStatus status_;
  PipelineOptions options_;
  std::shared_ptr<ExecutionContext> running_;
  bool stopping_ = false;
  bool stale_links_ = false;  // true if options that affect links changed after the links were made

  // Only the solver's thread uses the following members.
  std::shared_ptr<const PatchVisibility> visibility_;
  std::unique_ptr<Pipeline> pipeline_;
  // The earlier solution whose links this session keeps; null if the session makes links of its own.
  std::shared_ptr<const PipelineState> restart_;
  bool settled_ = false;  // true if the iterations have ended
  // True if pipeline_ holds a solution from a file. The next step of the solver then starts from the
  // beginning.
  bool stored_ = false;

  std::thread thread_;
};

}  // namespace penumbra::viewer
