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
  LightChange scene_change;   // by which `scene` differs from the scene that was opened
  bool settled = false;       // the iterations have ended
  bool stored = false;        // it shows the results from a file, from which it cannot continue
  std::uint64_t changes = 0;  // the number of steps that have changed its light
};

// A state of the session.
struct SolverPlace {
  std::shared_ptr<const Snapshot> snapshot;
  std::shared_ptr<const Snapshot> unlit;  // before the light changed; null: it has not
  std::shared_ptr<HeldPipeline> held;     // null before links
  std::uint64_t changes = 0;              // of `held` at this state
  std::shared_ptr<const Scene> opened;
  std::shared_ptr<const PipelineState> restart;
  PipelineOptions options;
  LightChange change;
  double unsaved_seconds = 0;
  std::size_t step = 0;  // the number of records that led here
};

// A step that the session has made.
struct StepRecord {
  std::string name;      // "link", "sweep", "split", ...
  double seconds = 0;    // that it took
  double residual = -1;  // of the light over the links; negative: unknown
  // How much the step changed the light: the root mean square of the change of the patches' irradiance,
  // relative to the mean irradiance; negative: unknown.
  double change = -1;
  double error = -1;  // 99th percentile of what is shown; negative: not measured
  std::size_t links = 0, leaves = 0, triangles = 0;
  std::shared_ptr<const SolverPlace> place;  // null: too far back to return to
};

// The memory of what a place alone holds, roughly [bytes].
std::size_t BytesOf(const SolverPlace& place);
// StepRecord::change from one light to another of the same patches.
double ChangeOfLight(const LightState* before, const LightState& now);

}  // namespace penumbra::viewer
