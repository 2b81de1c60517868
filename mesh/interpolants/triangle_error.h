// mesh/interpolants/triangle_error.h
//
// Representation error (thesis 4.4.2): the difference between a triangle's interpolant and the irradiance,
// measured at additional points of the triangle.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"

namespace penumbra {

// Statistics of |interpolant - true| / max(true, kErrorFloor * mean of the channel), over the additional
// points and the channels.
struct TriangleError {
  double max = 0, rms = 0;
};

struct MeasuredTriangles {
  std::vector<TriangleError> errors;  // one per triangle of the mesh; zero for triangles not measured
  std::size_t point_evaluations = 0;
};

struct TriangleSampling {
  int samples = 1;  // per side of a triangle
  Rgb mean;         // mean irradiance of each channel [W/m^2]
};

// Measures the listed triangles at samples^2 points each: lines parallel to the sides cut the triangle into
// congruent triangles, whose centroids are the points (SAMPLES in the thesis, Appendix A). Points in the
// cache are not evaluated again. REQUIRES: samples >= 1.
MeasuredTriangles MeasureTriangles(const Scene& scene, const IrradianceMesh& mesh,
                                   std::span<const std::uint32_t> triangles, const TriangleSampling& sampling,
                                   const IrradianceSampler& sampler, SampleCache* cache = nullptr);

// Estimates of TriangleError::max from the interpolants alone, without evaluations. Where the irradiance is
// smooth, so is its gradient; the jump of the interpolants' gradient across an edge therefore indicates the
// error of the interpolants. The estimates indicate which triangles are worth measuring. Edges on
// discontinuities contribute nothing. `mean` is the mean irradiance of each channel [W/m^2].
std::vector<double> GuessTriangleErrors(const Scene& scene, const IrradianceMesh& mesh, const Rgb& mean);

// For each patch, the area of the triangles whose TriangleError::max is above `error` [m^2].
std::vector<double> AreaAbove(const Scene& scene, const IrradianceMesh& mesh,
                              std::span<const TriangleError> errors, double error);

// The area-weighted mean of the interpolants over the reflecting patches (ReflectingAreas), for each channel
// [W/m^2].
Rgb MeanIrradiance(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
