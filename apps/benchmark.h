// apps/benchmark.h

#pragma once

#include <functional>
#include <string>

#include "display/two_pass_display.h"

namespace penumbra {

// A function that draws and tone-maps a frame, and returns the times of the steps.
using DrawFrame = std::function<FrameTimes(const Camera&)>;

struct BenchmarkSettings {
  Camera camera;
  int width = 0, height = 0;  // of a frame, for the output
  int frames = 0;
  std::size_t triangles = 0;  // for the output
};

// Draws one frame without measuring it, so that memory is allocated. After this frame, draws and measures
// `frames` frames while the camera makes one orbit around Camera::look_at. Returns a line of JSON: `fps` is
// the number of frames per second of wall-clock time; `ms` holds the mean time of each step per frame.
std::string RunBenchmark(const BenchmarkSettings& settings, const DrawFrame& draw);

}  // namespace penumbra
