// experiments/reference/path_tracer.h
//
// Computes the irradiance at points by path tracing, as a reference for the solver. The path tracer is slow
// and simple, and shares no source of error with the solver. Of the solver's code, the path tracer uses only
// the Scene.
//
// Direct light is estimated from random points on the emitters. Reflected light is estimated by paths whose
// directions are distributed by the cosine. At each patch that a path meets, the direct light from a random
// point on an emitter is added. Russian roulette ends paths without bias. The random numbers are scrambled
// Sobol points, in several independent replicates. The spread of the replicates gives the standard error. In
// the path tracer, a patch emits and reflects light only on its front, and its back is black.

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
  Vec3 normal = Vec3::UnitZ();   // unit vector
};

struct PathTracerOptions {
  double target = 0.0005;  // largest standard error / irradiance, in each channel
  // The largest number of paths for one point. The standard error misses its target if a point would need
  // more than max_paths paths.
  std::uint64_t max_paths = std::uint64_t{1} << 22;
  std::uint64_t seed = 1;
  // A path whose weight falls below `roulette` is continued with the probability weight / roulette, and then
  // has the weight `roulette`.
  double roulette = 0.1;
};

struct ReferenceIrradiance {
  Rgb total = Rgb::Zero(), error = Rgb::Zero();  // irradiance and its standard error [W/m^2]
  Rgb direct = Rgb::Zero();        // part of the irradiance that comes directly from emitters [W/m^2]
  Rgb direct_error = Rgb::Zero();  // standard error of `direct` [W/m^2]
  std::uint64_t paths = 0, direct_samples = 0;
  std::uint64_t rays = 0;
};

class PathTracer {
 public:
  // The number of independent estimates (replicates) whose spread gives the standard error. The standard
  // error itself has a relative error of about 1 / sqrt(30), and errors divided by the standard error follow
  // Student's distribution with 15 degrees of freedom.
  static constexpr int kReplicates = 16;

  PathTracer(const Scene& scene, const PathTracerOptions& options);  // `scene` must outlive the object

  // Returns the irradiance at the point. `sequence` selects the sequence of random numbers. If the point lies
  // on a patch, patches in the plane of this patch neither light the point nor block light. At() may be
  // called from any thread.
  ReferenceIrradiance At(const IrradiancePoint& point, std::uint64_t sequence) const;

  // Returns the irradiance at many points. The irradiances do not depend on the number of threads. The list
  // of irradiances is empty if the computation is cancelled.
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
