// display/two_pass_display.h
//
// The online half (thesis 3.4): at every pixel the visible triangle, its barycentric coordinates there, and
// the radiosity, interpolant x reflectance + emittance.

#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "display/image.h"
#include "display/rasteriser.h"
#include "display/tone_mapping.h"
#include "display/vector_kernels.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

enum class ShadingMode {
  kRadiosity,    // [W/m^2], emittance included
  kReflectance,  // [1], emitters like any surface
};

// What the last frame took, milliseconds of wall clock. Where all is done tile by tile, each gets the part of
// the frame that the threads spent in it, measured in some of the rows of blocks.
struct FrameTimes {
  double triangle_ids = 0, barycentric = 0, evaluate = 0, tone_map = 0;

  double Total() const { return triangle_ids + barycentric + evaluate + tone_map; }
  FrameTimes& operator+=(const FrameTimes& other) {
    triangle_ids += other.triangle_ids;
    barycentric += other.barycentric;
    evaluate += other.evaluate;
    tone_map += other.tone_map;
    return *this;
  }
  FrameTimes& operator*=(double factor) {
    triangle_ids *= factor;
    barycentric *= factor;
    evaluate *= factor;
    tone_map *= factor;
    return *this;
  }
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
  // Takes what it needs from both; neither is referred to afterwards. The passes are the rasteriser's.
  // REQUIRES: a triangle and an interpolant each, patches of the scene.
  TwoPassDisplay(const Scene& scene, const IrradianceMesh& mesh);
  // With passes that somebody else draws. REQUIRES: they draw the mesh's triangles.
  TwoPassDisplay(const Scene& scene, const IrradianceMesh& mesh, std::unique_ptr<Passes> passes);

  // Fills everything of the frame but `screen`. The same bytes for every number of threads.
  // Throws InputError if the camera cannot see (ValidateCamera).
  const RenderedFrame& Render(const Camera& camera, int width, int height,
                              ShadingMode mode = ShadingMode::kRadiosity);

  // Fills `screen` from the last Render.
  const RenderedFrame& ToneMap(const ToneMapping& settings);

  // What Render() and then ToneMap() would leave in `screen`, the same bytes, and nothing but that: each tile
  // goes from the triangles to the screen while it is in the caches. For frames that nobody asks about.
  const RenderedFrame& RenderScreen(const Camera& camera, int width, int height, ShadingMode mode,
                                    const ToneMapping& settings);

  const RenderedFrame& frame() const { return frame_; }
  std::size_t TriangleCount() const { return kind_.size(); }

 private:
  void DrawPasses(const Camera& camera, int width, int height);
  template <class Finish>
  void DrawTiles(const std::vector<TriangleShade>& shades, float background, double FrameTimes::*finishing,
                 const Finish& finish);

  std::unique_ptr<Passes> passes_;
  Rasteriser* rasteriser_;                  // passes_, if they can draw tile by tile; else null
  std::vector<TriangleShade> radiosity_;    // per triangle
  std::vector<TriangleShade> screen_;       // the same, emitters brighter than any screen
  std::vector<TriangleShade> reflectance_;  // per triangle: constants that evaluate to the reflectance
  std::vector<PixelKind> kind_;             // per triangle
  std::vector<FrameTimes> tile_times_;
  RenderedFrame frame_;
};

// The rasteriser of a mesh's triangles.
std::unique_ptr<Passes> SoftwarePasses(const IrradianceMesh& mesh);

}  // namespace penumbra
