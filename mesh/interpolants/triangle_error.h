// mesh/interpolants/triangle_error.h
//
// Representation error (thesis 4.4.2): the difference between a triangle's interpolant and the exact
// irradiance, measured at additional points of the triangle.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"

namespace penumbra {

class Enclosure;

// Statistics of the relative error |interpolant - true| / max(true, kErrorFloor * mean of the channel), over
// the additional points of a triangle and the channels.
struct TriangleError {
  double max = 0, rms = 0;
};

struct MeasuredTriangles {
  // The error of each triangle of the mesh; 0 for triangles that were not measured.
  std::vector<TriangleError> errors;
  std::size_t point_evaluations = 0;
};

struct TriangleSampling {
  // Each side of a triangle is cut into `samples` intervals, and samples^2 points are measured.
  int samples = 1;
  Rgb mean;  // the mean irradiance over the scene, in each colour channel [W/m^2]
  // If given, points that get no light and that nobody can see count as exact.
  const Enclosure* enclosure = nullptr;
};

// Measures the listed triangles at samples^2 points each. Lines parallel to the sides cut a triangle into
// samples^2 congruent triangles, whose centroids are the points (SAMPLES in the thesis, Appendix A). Points
// whose irradiance is in the cache are not evaluated again. REQUIRES: samples >= 1.
MeasuredTriangles MeasureTriangles(const Scene& scene, const IrradianceMesh& mesh,
                                   std::span<const std::uint32_t> triangles, const TriangleSampling& sampling,
                                   const IrradianceSampler& sampler, SampleCache* cache = nullptr);

// Estimates TriangleError::max from the mesh's interpolants alone, without evaluations of the irradiance.
// Where the irradiance is smooth, its gradient is continuous. A jump of the interpolants' gradient across an
// edge therefore indicates an error of the interpolants. The estimated errors indicate which triangles are
// worth measuring. Edges of triangles that lie on discontinuities contribute nothing to the estimate. `mean`
// is the mean irradiance of each channel [W/m^2].
std::vector<double> GuessTriangleErrors(const Scene& scene, const IrradianceMesh& mesh, const Rgb& mean);

// Returns, for each patch, the area of the triangles whose TriangleError::max is above `error` [m^2].
std::vector<double> AreaAbove(const Scene& scene, const IrradianceMesh& mesh,
                              std::span<const TriangleError> errors, double error);

// Returns the area-weighted mean of the interpolants over the reflecting patches (ReflectingAreas), for each
// channel [W/m^2].
Rgb MeanIrradiance(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
