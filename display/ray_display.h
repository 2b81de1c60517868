// display/ray_display.h
//
// Pictures by rays (thesis, B.3.3): several through each pixel, and irradiance where they meet a front. Slow,
// and a reference: RayShade shows exact irradiance, LerpShade the interpolants that the two-pass display
// shows, found another way.

#pragma once

#include <functional>
#include <vector>

#include "display/camera.h"
#include "display/image.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/base/progress.h"
#include "solver/scene/scene.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

// Where a ray meets the front of a patch.
struct RayPoint {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();  // [m], in the patch's plane
  double uncertainty = 0;        // of the position [m]: the rounding of the ray and of the meeting
};

// The irradiance that a picture shows there [W/m^2]. Called from several threads at once.
using RayShader = std::function<Rgb(const RayPoint&)>;

// What is given must outlive the shader. Exact irradiance.
RayShader RayShade(const Scene& scene, const PointIrradiance& irradiance);
// The interpolant of the mesh, not below 0, as the two-pass display shows it.
RayShader LerpShade(const Scene& scene, const IrradianceMesh& mesh);

// A picture of several samples a pixel.
struct SampledPicture {
  int samples = 1;              // a pixel's samples are neighbours in a row
  RgbImage linear;              // radiosity [W/m^2], emittance included; 0 where a ray meets nothing
  std::vector<PixelKind> kind;  // one a sample
};

// What one ray meets.
struct RaySample {
  Rgb radiosity = Rgb::Zero();  // [W/m^2], emittance included
  PixelKind kind = PixelKind::kBackground;
};

class RayDisplay {
 public:
  // The scene must outlive the display.
  RayDisplay(const Scene& scene, RayShader shader, int samples);

  // Casts `samples` rays through each pixel: the first through its centre, the others spread evenly over it.
  // If the context is cancelled the rest of the picture is left out. The same bytes for every number of
  // threads. Throws InputError if the camera cannot see (ValidateCamera).
  const SampledPicture& Render(const Camera& camera, int width, int height, const ExecutionContext& context);

  const SampledPicture& picture() const { return picture_; }

  // The ray through the point (x, y) of a picture. Safe from several threads at once.
  RaySample Sample(const PixelRays& rays, double x, double y) const;

 private:
  const Scene& scene_;
  RayCaster rays_;
  RayShader shader_;
  SampledPicture picture_;
};

}  // namespace penumbra
