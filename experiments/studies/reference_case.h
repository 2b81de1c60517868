// experiments/studies/reference_case.h
//
// Scenes with a committed reference, and what solutions of them are measured by.

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

// The floor below which an error is no longer relative to a place's own light: of the channel's mean.
inline constexpr double kDark = 0.01;

struct ReferenceCase {
  std::string name;
  Scene scene;
  std::vector<ReferencePoint> points;
};

// `name` is a built-in scene with a file in experiments/reference, or `box` or `box_grey` of
// experiments/peers. Throws InputError where the files are missing.
ReferenceCase LoadReferenceCase(const std::string& name);

// The relative errors of a value at every point and channel: |value - reference| beyond two standard errors
// of the reference, over the reference or 1 % of the channel's mean, whichever is larger. Points without a
// value are left out.
std::vector<double> ReferenceErrors(const ReferenceCase& test,
                                    const std::function<std::optional<Rgb>(const ReceiverPoint&)>& value);

// The interpolant at a point, from the first patch that the point lies on the front of, as `probe` has it.
std::optional<Rgb> ShownAt(const Pipeline& pipeline, const ReceiverPoint& at);

// The settings that the thesis gives for its office (7.1), and no refinement that it had not.
PipelineOptions ThesisSettings();

// A solve with its mesh: the median of the repeats' seconds of processors, counts, and the errors of what is
// shown.
struct Measured {
  StudyRow row;
  std::unique_ptr<Pipeline> pipeline;  // the last of the repeats
};
Measured MeasurePipeline(const ReferenceCase& test, const PipelineOptions& options, int repeats);

}  // namespace penumbra
