// experiments/studies/reference_case.h
//
// Scenes with reference irradiances that are stored in the repository, and measures of the errors of
// solutions of these scenes.

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/study.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The smallest denominator of a relative error, as a fraction of the channel's mean irradiance.
inline constexpr double kDark = 0.01;

struct ReferenceCase {
  std::string name;
  Scene scene;
  std::vector<ReferencePoint> points;
};

// Loads the scene `name` and its reference irradiances. `name` is a built-in scene with a file in
// experiments/reference, or `box` or `box_grey` in experiments/peers. Throws InputError if the files of the
// scene or of its reference are missing.
ReferenceCase LoadReferenceCase(const std::string& name);

// Returns the relative errors of `value` at every point of the reference and in every channel. An error is
// max(0, |value - reference| - 2 * (standard error of the reference)) / max(reference, 1 % of the channel's
// mean). Points where `value` returns nullopt are omitted from the errors.
std::vector<double> ReferenceErrors(const ReferenceCase& test,
                                    const std::function<std::optional<Rgb>(const ReceiverPoint&)>& value);

// Returns the patch whose front contains the point, the first one of several; nullopt if there is none.
// REQUIRES: the pipeline has a mesh.
std::optional<PatchId> PatchBelow(const Pipeline& pipeline, const ReceiverPoint& at);

// Returns the irradiance of the mesh's interpolant at a point. A point that lies on the fronts of several
// patches belongs to the first of these patches, as in the command `probe`.
std::optional<Rgb> ShownAt(const Pipeline& pipeline, const ReceiverPoint& at);

// Returns the settings that the thesis gives for its office scene (thesis 7.1), without refinements that are
// newer than the thesis.
PipelineOptions ThesisSettings();

// The measurements of a solve and its mesh: the median processor time of several repeats, counts, and the
// errors of the displayed irradiance.
struct Measured {
  StudyRow row;
  std::unique_ptr<Pipeline> pipeline;  // pipeline of the last repeat
};
Measured MeasurePipeline(const ReferenceCase& test, const PipelineOptions& options, int repeats);

}  // namespace penumbra
