// display/two_pass_display.h
//
// The online half (thesis 3.4): at every pixel the visible triangle, its barycentric coordinates there, and
// the radiosity, interpolant x reflectance + emittance.

#pragma once

#include <cstdint>
#include <vector>

#include "display/image.h"
#include "display/rasteriser.h"
#include "display/tone_mapping.h"
#include "display/vector_kernels.h"
#include "mesh/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

enum class ShadingMode {
  kRadiosity,    // [W/m^2], emittance included
  kReflectance,  // [1], emitters like any surface
};

// What the last frame took, milliseconds of wall clock.
struct FrameTimes {
  double triangle_ids = 0, barycentric = 0, evaluate = 0, tone_map = 0;

  double Total() const { return triangle_ids + barycentric + evaluate + tone_map; }
};

// A picture with everything that was found on the way to it; arrays hold width * height values, rows from the
// top.
struct RenderedFrame {
  int width = 0, height = 0;
  std::vector<std::uint32_t> triangle;  // index in IrradianceMesh::triangles, or kNoTriangle
  std::vector<float> s, t;              // barycentric coordinates in it; unspecified where there is none
  RgbImage linear;                      // radiosity or reflectance, unexposed; 0 where there is no triangle
  std::vector<PixelKind> kind;          // emitters count as such in kRadiosity only
  Srgb8Image screen;                    // what ToneMap made of it
  FrameTimes ms;
};

// Draws an irradiance mesh from any camera. Memory is taken with the first frame of a size and kept.
class TwoPassDisplay {
 public:
  // Takes what it needs from both; neither is referred to afterwards.
  // REQUIRES: a triangle and an interpolant each, patches of the scene.
  TwoPassDisplay(const Scene& scene, const IrradianceMesh& mesh);

  // Fills everything of the frame but `screen`. The same bytes for every number of threads.
  // Throws InputError if the camera cannot see (ValidateCamera).
  const RenderedFrame& Render(const Camera& camera, int width, int height,
                              ShadingMode mode = ShadingMode::kRadiosity);

  // Fills `screen` from the last Render.
  const RenderedFrame& ToneMap(const ToneMapping& settings);

  const RenderedFrame& frame() const { return frame_; }
  std::size_t TriangleCount() const { return rasteriser_.TriangleCount(); }

 private:
  void Evaluate(const std::vector<TriangleShade>& shades, ShadingMode mode);

  Rasteriser rasteriser_;
  std::vector<TriangleShade> radiosity_;    // per triangle
  std::vector<TriangleShade> reflectance_;  // per triangle: constants that evaluate to the reflectance
  std::vector<PixelKind> kind_;             // per triangle
  RenderedFrame frame_;
};

}  // namespace penumbra
