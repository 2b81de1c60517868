// display/viewer/solver_session.h
//
// The offline half in a separate thread, in single steps, so that a window never waits for it.

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

// All members except the destructor are safe from any thread; only the destructor waits for the solver. Tasks
// run one after another, in the order of the calls.
class SolverSession {
 public:
  // For a solution, the solution's options replace `options`.
  SolverSession(const OpenedScene& opened, const PipelineOptions& options);
  // Cancels, and waits for the end of the running step.
  ~SolverSession();
  SolverSession(const SolverSession&) = delete;
  SolverSession& operator=(const SolverSession&) = delete;

  // The latest state; never null. The state contains only complete steps.
  std::shared_ptr<const Snapshot> snapshot() const;
  SessionStatus status() const;

  // Starts with another scene, or from a solution. If links are given (OpenedScene::restart), linking and
  // iterating compute the light over these links; the options that determine the links (IsLinkOption) must
  // then equal those of the given links.
  void SetScene(const OpenedScene& opened);
  // Sets the options of later tasks. If options of the links change, the next iteration starts from the
  // beginning.
  void SetOptions(const PipelineOptions& options);
  // Sets PipelineOptions::error_points of later measurements, without effect on other results.
  void SetErrorPoints(std::size_t points);
  PipelineOptions options() const;

  void Link();      // from the beginning
  void Iterate();   // links first if there are no links
  void Converge();  // iterates until convergence, then corrects
  void Correct();   // by exact irradiance
  // Builds the mesh for a display mode, from the state at the start of the task. Once the solver has settled,
  // a request for interpolants refines the light first (Pipeline::RefineLight), and shows it.
  void BuildMesh(MeshKind kind);
  // Measures energy and the errors of the interpolants, which it builds if necessary. For a solution from a
  // file, the file's measurements remain.
  void Measure();
  // Runs Measure(), then `write`.
  void Save(std::function<void(const Pipeline&)> write);
  // Runs another long task that reads the latest state, for example for a picture. An InputError from the
  // task becomes the status message.
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

  // For the solver's thread only.
  std::shared_ptr<const PatchVisibility> visibility_;
  std::unique_ptr<Pipeline> pipeline_;
  std::shared_ptr<const PipelineState> restart_;  // its links transport the light; null: the scene's own
  bool settled_ = false;                          // the iterations have ended
  bool stored_ = false;  // pipeline_ shows the results from a file, from which it cannot continue

  std::thread thread_;
};

}  // namespace penumbra::viewer
