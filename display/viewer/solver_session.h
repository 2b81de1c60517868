// display/viewer/solver_session.h
//
// The offline half in a thread of its own, a step at a time, so that a window never waits for it.

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
  std::string phase;    // what is being done
  double fraction = 0;  // of it, in [0, 1]
  std::string message;  // what went wrong last; empty: nothing
};

// All members but the destructor may be called from any thread; none but the destructor waits for the solver.
// Tasks are done one after the other, in the order asked for.
class SolverSession {
 public:
  // Of a solution, its own options count.
  SolverSession(const OpenedScene& opened, const PipelineOptions& options);
  // Cancels, and waits for the step at hand to end.
  ~SolverSession();
  SolverSession(const SolverSession&) = delete;
  SolverSession& operator=(const SolverSession&) = delete;

  // The latest state; never null. A step that is under way shows once it is whole.
  std::shared_ptr<const Snapshot> snapshot() const;
  SessionStatus status() const;

  // Starts over with another scene, or goes on from a solution. Where the links are given, linking and
  // iterating are lighting the scene over them; the options that say how links are made (IsLinkOption) have
  // to be those of the links.
  void SetScene(const OpenedScene& opened);
  // For what is done from now on. Where options of the links change, the next iteration starts over.
  void SetOptions(const PipelineOptions& options);
  // PipelineOptions::error_points of what is measured from now on: nothing else starts over for them.
  void SetErrorPoints(std::size_t points);
  PipelineOptions options() const;

  void Link();      // from the beginning
  void Iterate();   // links where there are none yet
  void Converge();  // iterates until it is done, then corrects
  void Correct();   // by exact irradiance
  // For a display mode, from the state then. Once the solver has settled, interpolants refine the solution as
  // well, as they do for Pipeline::BuildMesh.
  void BuildMesh(MeshKind kind);
  // Energy and errors of the interpolants, built where they are not there. Of a solution, what it brought.
  void Measure();
  // Writes what is solved, after Measure().
  void Save(std::function<void(const Pipeline&)> write);
  // Anything else that takes long and reads the latest state: pictures, say. What it throws as InputError is
  // shown.
  void Run(const std::string& phase,
           std::function<void(const Snapshot&, const ExecutionContext& context)> work);

  // Ends the task at hand after its last whole step, and forgets those that wait.
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

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  std::deque<std::pair<std::string, Task>> tasks_;
  std::shared_ptr<const Snapshot> snapshot_;
  SessionStatus status_;
  PipelineOptions options_;
  std::shared_ptr<ExecutionContext> running_;
  bool stopping_ = false;
  bool stale_links_ = false;  // options changed since the links were made

  // Of the solver's thread alone.
  std::shared_ptr<const PatchVisibility> visibility_;
  std::unique_ptr<Pipeline> pipeline_;
  std::shared_ptr<const PipelineState> restart_;  // whose links the scene is lit over; null: its own
  bool settled_ = false;                          // its iterations have come to their end
  bool stored_ = false;                           // it shows what a file brought, and cannot go on from there

  std::thread thread_;
};

}  // namespace penumbra::viewer
