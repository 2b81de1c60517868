// apps/benchmark.h

#pragma once

#include <functional>
#include <string>

#include "display/two_pass_display.h"

namespace penumbra {

// A function that draws and tone-maps a frame, and returns the duration of each step.
using DrawFrame = std::function<FrameTimes(const Camera&)>;

struct BenchmarkSettings {
  Camera camera;
  int width = 0, height = 0;  // size of the frames in pixels, reported in the output
  int frames = 0;
  std::size_t triangles = 0;  // number of triangles, reported in the output
};

// Measures how fast frames are drawn. The first frame, in which memory is allocated, is not measured; then
// `frames` frames are drawn while the camera makes one orbit around Camera::look_at. Returns a line of JSON:
// `fps` is the number of frames per second of wall-clock time; `ms` holds the mean time of each step per
// frame, in milliseconds.
std::string RunBenchmark(const BenchmarkSettings& settings, const DrawFrame& draw);

}  // namespace penumbra
