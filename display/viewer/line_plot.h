// display/viewer/line_plot.h
//
// Irradiance along a line on a face, which the user draws with two clicks.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "display/viewer/snapshot.h"
#include "display/viewer/view_state.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

struct LinePlot {
  PlotLine line;
  struct Sample {
    double distance = 0;  // from the first end [m]
    Vec3 position = Vec3::Zero();
    bool on_face = false;             // the line may leave the faces of its plane
    Rgb exact = Rgb::Zero();          // [W/m^2]
    std::optional<Rgb> interpolated;  // [W/m^2], of the given mesh
  };
  std::vector<Sample> samples;  // at equal distances, the ends included
};

// Samples the line at kLineSamples points. A point belongs to the patch in the plane of the line's patch that
// contains it.
LinePlot PlotAlong(const LightState& light, const MeshState* mesh, const PlotLine& line,
                   const ExecutionContext& context);
inline constexpr int kLineSamples = 201;

// The samples on faces as CSV: distance [m], position [m], exact and interpolated irradiance [W/m^2]. Values
// without an interpolant are `nan`.
std::string LinePlotCsv(const LinePlot& plot);

// The line's text, `x,y,z x,y,z`, or `none`.
std::string TextOf(const std::optional<PlotLine>& line);
// The line on the scene's face that contains both ends. Throws InputError if the text is no line, or if no
// face of the scene contains its ends.
std::optional<PlotLine> ParseLine(const Scene& scene, const std::string& text);

}  // namespace penumbra::viewer
