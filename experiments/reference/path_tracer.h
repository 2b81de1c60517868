// experiments/reference/path_tracer.h
//
// Irradiance at points by tracing paths: slow, simple, and wrong in no way that the solver could be wrong in
// too. It knows the Scene and nothing else of the solver.
//
// Direct light: points on the emitters. Light from elsewhere: paths that leave with the cosine and go on
// from patch to patch, at each of which a point on an emitter is asked for; Russian roulette ends them
// without bias. The points are scrambled Sobol points in some independent replicates; the spread of the
// replicates is the standard error. A patch emits and reflects on its front; its back is black.

#pragma once

#include <cstdint>
#include <vector>

#include "experiments/reference/emitters.h"
#include "experiments/reference/ray_scene.h"
#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct IrradiancePoint {
  Vec3 position = Vec3::Zero();  // [m]
  Vec3 normal = Vec3::UnitZ();   // unit
};

struct PathTracerOptions {
  double target = 0.0005;  // standard error, relative to the irradiance, in each channel
  std::uint64_t max_paths = std::uint64_t{1} << 22;  // a point: the target may be missed
  std::uint64_t seed = 1;
  // Paths that would carry less than this are continued with a probability only, and then carry this.
  double roulette = 0.1;
};

struct ReferenceIrradiance {
  Rgb total = Rgb::Zero(), error = Rgb::Zero();  // irradiance and its standard error [W/m^2]
  Rgb direct = Rgb::Zero();                      // the part that comes from emitters directly [W/m^2]
  Rgb direct_error = Rgb::Zero();                // its standard error [W/m^2]
  std::uint64_t paths = 0, direct_samples = 0;
  std::uint64_t rays = 0;
};

class PathTracer {
 public:
  // Independent estimates whose spread is the standard error: it is itself known to a fifth or so (one over
  // the root of 30), and errors over it follow Student's distribution with 15 degrees of freedom.
  static constexpr int kReplicates = 16;

  PathTracer(const Scene& scene, const PathTracerOptions& options);  // the scene must outlive it

  // The irradiance at the point, which draws the random numbers of the given sequence. Patches in a plane
  // that holds the point and a patch around it neither light nor block. Safe from any thread.
  ReferenceIrradiance At(const IrradiancePoint& point, std::uint64_t sequence) const;

  // The same for many points at once; the numbers do not depend on how many threads work. Empty if cancelled.
  std::vector<ReferenceIrradiance> At(const std::vector<IrradiancePoint>& points,
                                      const ExecutionContext& context = {}) const;

 private:
  struct Work;
  Rgb Direct(const Vec3& at, PlaneId plane, const Vec3& normal, const std::array<double, 3>& random,
             std::uint64_t& rays) const;
  Rgb Indirect(Work& work, int replicate) const;

  const Scene& scene_;
  PathTracerOptions options_;
  RayScene rays_;
  Emitters emitters_;
};

}  // namespace penumbra
