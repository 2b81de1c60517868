// display/viewer/solver_place.h
//
// States to which a session can return, and the record of the steps that led to them.

#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "display/viewer/light_change.h"
#include "display/viewer/snapshot.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra::viewer {

// A pipeline, which steps change in place, with its scene.
struct HeldPipeline {
  std::shared_ptr<const Scene> scene;
  std::unique_ptr<Pipeline> pipeline;
  std::shared_ptr<const PatchVisibility> visibility;
  PipelineOptions made_with;
  LightChange scene_change;  // how the light of `scene` differs from that of the scene that the user opened
  bool settled = false;      // true if the solver's iterations have ended
  // True if the pipeline holds results from a solution file, from which it cannot continue.
  bool stored = false;
  std::uint64_t changes = 0;  // the number of solver steps that have changed the light of the pipeline
};

// A state of the session.
struct SolverPlace {
  std::shared_ptr<const Snapshot> snapshot;
  // The snapshot before lamps or materials were changed; null if none was changed.
  std::shared_ptr<const Snapshot> unlit;
  std::shared_ptr<HeldPipeline> held;  // null until the solver has made links between elements
  std::uint64_t changes = 0;           // the value of held->changes when the session was in this state
  std::shared_ptr<const Scene> opened;
  std::shared_ptr<const PipelineState> restart;
  PipelineOptions options;
  LightChange change;
  double unsaved_seconds = 0;
  std::size_t step = 0;  // the number of step records that led to this state
};

// A step that the session has made.
struct StepRecord {
  std::string name;    // the name of the solver's step, such as "link", "sweep" or "split"
  double seconds = 0;  // the time that the step took [s]
  // The residual of the light that links transport, after the step; negative if unknown.
  double residual = -1;
  // How much the step changed the light: the root mean square of the change of the patches' irradiance,
  // relative to the mean irradiance; negative: unknown.
  double change = -1;
  // The 99th percentile of the relative error of the shown irradiance; negative if not measured.
  double error = -1;
  std::size_t links = 0, leaves = 0, triangles = 0;
  // The state after the step; null if the step is too far back to return to.
  std::shared_ptr<const SolverPlace> place;
};

// The memory of what a place alone holds, roughly [bytes].
std::size_t BytesOf(const SolverPlace& place);
// StepRecord::change from one light to another of the same patches.
double ChangeOfLight(const LightState* before, const LightState& now);

}  // namespace penumbra::viewer
