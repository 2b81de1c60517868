// display/two_pass_display.h
//
// The two-pass display, the interactive half of the thesis's method (3.4). For every pixel, the display finds
// the visible triangle and the barycentric coordinates of the visible point, and evaluates the radiosity:
// (interpolated irradiance) * reflectance + emittance.

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
  kRadiosity,    // radiosity including emittance [W/m^2]
  kReflectance,  // reflectance [1]; emitters are treated as surfaces
};

// The times of the last frame, in milliseconds of wall clock. If a frame is drawn tile by tile, the time of
// each step is estimated: the total time is divided in proportion to the times that threads spend in each
// step. The times that threads spend in each step are measured only for a sample of the rows of 4 x 4 blocks.
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

// A picture of the two-pass display with its intermediate results. Each array has width * height values, rows
// from the top.
struct RenderedFrame {
  int width = 0, height = 0;
  // For each pixel, the index of the visible triangle in IrradianceMesh::triangles, or kNoTriangle.
  std::vector<std::uint32_t> triangle;
  // For each pixel, the barycentric coordinates in the visible triangle; unspecified without one.
  std::vector<float> s, t;
  RgbImage linear;              // unexposed radiosity [W/m^2] or reflectance [1]; 0 without a triangle
  std::vector<PixelKind> kind;  // kEmitter occurs in mode kRadiosity only
  Srgb8Image screen;            // the picture for the screen, made by ToneMap()
  FrameTimes ms;
};

// Draws an irradiance mesh for any camera. A TwoPassDisplay allocates memory for the first frame of each size
// and reuses the memory for later frames.
class TwoPassDisplay {
 public:
  // Copies the required data from scene and mesh. The software rasteriser draws the two passes. REQUIRES: the
  // mesh has an interpolant for each triangle, and its patches are patches of the scene.
  TwoPassDisplay(const Scene& scene, const IrradianceMesh& mesh);
  // Makes a display that draws with the given passes, for example by OpenGL. REQUIRES: `passes` draws the
  // triangles of the mesh.
  TwoPassDisplay(const Scene& scene, const IrradianceMesh& mesh, std::unique_ptr<Passes> passes);

  // Computes all members of the RenderedFrame except `screen`. The frame does not depend on the number of
  // threads. Throws InputError if ValidateCamera() rejects the camera.
  const RenderedFrame& Render(const Camera& camera, int width, int height,
                              ShadingMode mode = ShadingMode::kRadiosity);

  // Computes RenderedFrame::screen from the frame of the last Render().
  const RenderedFrame& ToneMap(const ToneMapping& settings);

  // Computes only RenderedFrame::screen, to the same bytes as Render() followed by ToneMap(). All steps are
  // applied to one tile before the next tile, so that the data of a tile remain in the processor's caches.
  // Use RenderScreen() for frames whose intermediate results are not needed.
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
  Rasteriser* rasteriser_;  // passes_ as a Rasteriser, which can draw tile by tile; null for other passes
  std::vector<TriangleShade> radiosity_;  // data from which the radiosity of each triangle is computed
  // Like radiosity_, except that emitters have infinite radiosity, so that any exposure shows them white.
  std::vector<TriangleShade> screen_;
  std::vector<TriangleShade> reflectance_;  // data from which the reflectance of each triangle is computed
  std::vector<PixelKind> kind_;             // kind of each triangle
  std::vector<FrameTimes> tile_times_;
  RenderedFrame frame_;
};

// Makes a software rasteriser for the triangles of a mesh.
std::unique_ptr<Passes> SoftwarePasses(const IrradianceMesh& mesh);

}  // namespace penumbra
