// apps/benchmark.h

#pragma once

#include <string>

#include "display/two_pass_display.h"

namespace penumbra {

struct BenchmarkSettings {
  Camera camera;
  int width = 0, height = 0;
  int frames = 0;
  ShadingMode mode = ShadingMode::kRadiosity;
  ToneMapping tone;
};

// Renders the frames along one turn of the camera about the point that it looks at, after one more that takes
// the memory. Returns the measured times as a line of JSON: `fps` over wall clock, `ms` the means a frame.
std::string RunBenchmark(TwoPassDisplay& display, const BenchmarkSettings& settings);

}  // namespace penumbra
