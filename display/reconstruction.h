// display/reconstruction.h
//
// Pictures of light that is reconstructed from the vertices of the solution's leaves: the methods that were
// in use before the interpolants of the thesis. They are shown by ray casting.

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "display/camera.h"
#include "display/ray_display.h"
#include "mesh/interpolants/vertex_light.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

enum class Reconstruction {
  // Means of the leaves at each vertex, bilinear in each leaf (Ashdown 1994, section 4.16).
  kNodal,
  // Means of the leaves at each vertex, interpolated along the edges of a leaf as they appear in the picture,
  // and then along each row of pixels (Gouraud 1971; Ashdown 1994, section 4.13). The light moves over a
  // surface when the camera turns.
  kGouraudScreen,
  kBilinear,  // exact irradiance at each vertex, bilinear in each leaf
  // Exact irradiance at each vertex, bicubic in each leaf of a quadrilateral (HermiteSurface, after Bastos
  // 1996), and linear in each leaf of a triangle.
  kBicubic,
};

// Light at the vertices of leaves, and what shows it. Several threads may call the shaders at once.
class ReconstructedLight {
 public:
  // The forest must outlive the ReconstructedLight. REQUIRES: `light` has all vertices of all leaves.
  ReconstructedLight(Reconstruction kind, const ElementForest& forest, std::vector<VertexLight> light);
  ~ReconstructedLight();
  ReconstructedLight(ReconstructedLight&&) noexcept;

  // The shader of one picture of width x height pixels. The ReconstructedLight must outlive the shader. Only
  // with kGouraudScreen does the shader depend on the camera and the size. Light below 0, which bicubic
  // pieces may have, is shown as 0. Throws InputError if ValidateCamera() rejects the camera.
  RayShader Shade(const Camera& camera, int width, int height) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

// The light of a solution at the vertices, as the kind of reconstruction needs it. `exact` returns the exact
// irradiance from the solution, and is called only by kinds that need it. The solution must outlive the
// ReconstructedLight. If the computation is cancelled, the light is unspecified.
ReconstructedLight ReconstructLight(Reconstruction kind, const RadiositySolution& solution,
                                    const std::function<const PointIrradiance&()>& exact,
                                    const ExecutionContext& context);
// The same for the solution of a pipeline, which must outlive the ReconstructedLight.
ReconstructedLight ReconstructLight(Reconstruction kind, const Pipeline& pipeline,
                                    const ExecutionContext& context);

}  // namespace penumbra
