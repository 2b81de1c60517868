// display/ray_display.h
//
// Pictures by ray casting (thesis B.3.3): one or several rays are cast through each pixel, and the irradiance
// is computed where a ray hits a front. Ray casting is slow and serves as a reference for the two-pass
// display. RayShade() shows exact irradiance. LerpShade() shows the interpolants of the irradiance mesh,
// without the two passes of the rasteriser.

#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "display/camera.h"
#include "display/image.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/base/progress.h"
#include "solver/scene/scene.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

// The intersection of a ray with the front of a patch.
struct RayPoint {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();  // point of intersection [m], in the patch's plane
  // uncertainty of the position [m], from rounding of the ray and of the intersection
  double uncertainty = 0;
};

// A function that returns the irradiance that a picture shows at a point [W/m^2]. Several threads call a
// RayShader at once.
using RayShader = std::function<Rgb(const RayPoint&)>;

// A shader that shows exact irradiance. The arguments of RayShade() must outlive the shader.
RayShader RayShade(const Scene& scene, const PointIrradiance& irradiance);
// A shader that shows the interpolants of the irradiance mesh, clamped to values >= 0 as in the two-pass
// display. The arguments of LerpShade() must outlive the shader.
RayShader LerpShade(const Scene& scene, const IrradianceMesh& mesh);

// A picture with several samples per pixel.
struct SampledPicture {
  int samples = 1;              // number of samples per pixel; the samples of a pixel are neighbours in a row
  RgbImage linear;              // radiosity with emittance [W/m^2]; 0 where a ray meets no front
  std::vector<PixelKind> kind;  // for each sample, whether its ray meets a surface, an emitter or nothing
};

// The radiosity that one ray of a picture finds, and the kind of object that the ray hits.
struct RaySample {
  Rgb radiosity = Rgb::Zero();  // radiosity that the ray finds, including emittance [W/m^2]
  PixelKind kind = PixelKind::kBackground;
};

class RayDisplay {
 public:
  // The scene must outlive the RayDisplay.
  RayDisplay(const Scene& scene, RayShader shader, int samples);

  // Casts `samples` rays through each pixel: the first ray through the pixel's centre, the others evenly
  // distributed over the pixel. If the computation is cancelled (ExecutionContext), the rest of the picture
  // is not computed. The picture does not depend on the number of threads. Throws InputError if
  // ValidateCamera() rejects the camera.
  const SampledPicture& Render(const Camera& camera, int width, int height, const ExecutionContext& context);

  const SampledPicture& picture() const { return picture_; }

  // Replaces the shader for later pictures.
  void SetShader(RayShader shader) { shader_ = std::move(shader); }

  // Casts the ray through the point (x, y) of a picture. Several threads may call Sample() at once.
  RaySample Sample(const PixelRays& rays, double x, double y) const;

 private:
  const Scene& scene_;
  RayCaster rays_;
  RayShader shader_;
  SampledPicture picture_;
};

}  // namespace penumbra
