// apps/benchmark.h

#pragma once

#include <functional>
#include <string>

#include "display/two_pass_display.h"

namespace penumbra {

// Draws and tone-maps a frame; returns the times of its steps.
using DrawFrame = std::function<FrameTimes(const Camera&)>;

struct BenchmarkSettings {
  Camera camera;
  int width = 0, height = 0;  // of a frame, for the output
  int frames = 0;
  std::size_t triangles = 0;  // for the output
};

// Draws one frame that allocates memory, and then the measured frames along one orbit of the camera around
// the point that it looks at. Returns a line of JSON: `fps` from wall-clock time, and `ms`, the mean times of
// the steps per frame.
std::string RunBenchmark(const BenchmarkSettings& settings, const DrawFrame& draw);

}  // namespace penumbra
