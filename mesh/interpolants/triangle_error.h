// mesh/interpolants/triangle_error.h
//
// How far a triangle's interpolant is from the irradiance: representation error (thesis 4.4.2), measured at
// extra points of it.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"

namespace penumbra {

// Relative to max(true, 1 % of the channel's mean), over the extra points and the channels.
struct TriangleError {
  double max = 0, rms = 0;
};

struct MeasuredTriangles {
  std::vector<TriangleError> errors;  // one a triangle of the mesh; zeros for those left out
  std::size_t point_evaluations = 0;
};

struct TriangleSampling {
  int samples = 1;  // along each side of a triangle
  Rgb mean;         // the channels' mean irradiance [W/m^2]
};

// At samples x samples points of each triangle named: the centroids of what lines parallel to two of its
// sides cut it into, each half of a parallelogram counted by its area (SAMPLES of the thesis, Appendix A).
// Points that the cache knows are not evaluated again. REQUIRES: samples >= 1.
MeasuredTriangles MeasureTriangles(const Scene& scene, const IrradianceMesh& mesh,
                                   std::span<const std::uint32_t> triangles, const TriangleSampling& sampling,
                                   const IrradianceSampler& sampler, SampleCache* cache = nullptr);

// What the interpolants alone tell, at no evaluation: where the irradiance is smooth its gradient is, too, so
// that the jump of the interpolants' gradient across an edge tells how far they are off. In the units of
// TriangleError::max; a guide to where to measure. Edges on discontinuities tell nothing.
std::vector<double> GuessTriangleErrors(const Scene& scene, const IrradianceMesh& mesh, const Rgb& mean);

// Of each patch the area of the triangles whose largest error is above that [m^2].
std::vector<double> AreaAbove(const Scene& scene, const IrradianceMesh& mesh,
                              std::span<const TriangleError> errors, double error);

// The area-weighted mean of the interpolants over the patches that are seen (ReflectingAreas), by channel
// [W/m^2].
Rgb MeanIrradiance(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
