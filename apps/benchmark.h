// apps/benchmark.h

#pragma once

#include <functional>
#include <string>

#include "display/two_pass_display.h"

namespace penumbra {

// Draws and tone-maps a frame; returns what its parts took.
using DrawFrame = std::function<FrameTimes(const Camera&)>;

struct BenchmarkSettings {
  Camera camera;
  int width = 0, height = 0;  // of what `draw` draws, to be told
  int frames = 0;
  std::size_t triangles = 0;  // to be told
};

// Draws the frames along one turn of the camera about the point that it looks at, after one more that takes
// the memory. Returns the measured times as a line of JSON: `fps` over wall clock, `ms` the means a frame.
std::string RunBenchmark(const BenchmarkSettings& settings, const DrawFrame& draw);

}  // namespace penumbra
