#include "apps/benchmark.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <numbers>

#include "solver/base/parallel.h"

namespace penumbra {
namespace {

// The camera after the part `turn` of a whole turn about its `up` through the point that it looks at.
Camera Orbit(const Camera& camera, double turn) {
  Camera turned = camera;
  const Vec3 axis = camera.up.stableNorm() > 0 ? camera.up.stableNormalized().eval() : Vec3::UnitZ().eval();
  turned.eye =
      camera.look_at + Eigen::AngleAxisd(2 * std::numbers::pi * turn, axis) * (camera.eye - camera.look_at);
  return turned;
}

}  // namespace

std::string RunBenchmark(const BenchmarkSettings& settings, const DrawFrame& draw) {
  draw(settings.camera);

  FrameTimes sum;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < settings.frames; ++i)
    sum += draw(Orbit(settings.camera, static_cast<double>(i) / settings.frames));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  const nlohmann::ordered_json line = {{"fps", settings.frames / seconds},
                                       {"ms",
                                        {{"triangle_ids", sum.triangle_ids / settings.frames},
                                         {"barycentric", sum.barycentric / settings.frames},
                                         {"evaluate", sum.evaluate / settings.frames},
                                         {"tone_map", sum.tone_map / settings.frames},
                                         {"total", sum.Total() / settings.frames}}},
                                       {"size", fmt::format("{}x{}", settings.width, settings.height)},
                                       {"triangles", settings.triangles},
                                       {"threads", ThreadCount()}};
  return line.dump() + "\n";
}

}  // namespace penumbra
