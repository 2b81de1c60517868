// mesh/interpolants/triangle_quality.h
//
// How well shaped the triangles of a mesh are. Slivers cost samples that tell little, and the quadratic of a
// long triangle follows the irradiance along it no better than that of a short one.

#pragma once

#include <array>

#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

// Over the triangles of a mesh. The aspect of a triangle is its longest side over the height on that side, as
// a multiple of an equilateral one's: 1 at best. All zero without triangles.
struct TriangleQuality {
  double smallest_angle = 0;   // of all [degrees]
  double median_angle = 0;     // of the triangles' smallest angles [degrees]
  double below_5_degrees = 0;  // share of triangles with an angle below that
  double slim_area = 0;        // their share of the area
  // Shares of triangles whose smallest angle lies in [0, 10), [10, 20) ... [50, 60] degrees.
  std::array<double, 6> angle_share = {};
  double median_aspect = 0, aspect_p95 = 0;
};

TriangleQuality MeasureQuality(const IrradianceMesh& mesh);

}  // namespace penumbra
