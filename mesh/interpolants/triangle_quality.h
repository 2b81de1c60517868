// mesh/interpolants/triangle_quality.h
//
// The shapes of a mesh's triangles. Long thin triangles are undesirable. The samples across the short side of
// a thin triangle add little information, and one quadratic must fit the irradiance over the whole length.

#pragma once

#include <array>

#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

// Statistics over the triangles of a mesh. The aspect of a triangle is (longest side / height on that side),
// divided by the same ratio of an equilateral triangle; 1 is the best. All members of TriangleQuality are
// zero for an empty mesh.
struct TriangleQuality {
  double smallest_angle = 0;   // the smallest angle of any triangle of the mesh [degrees]
  double median_angle = 0;     // median of the triangles' smallest angles [degrees]
  double below_5_degrees = 0;  // (number of triangles with an angle below 5 degrees) / (number of triangles)
  double slim_area = 0;        // (area of triangles with an angle below 5 degrees) / (area of all triangles)
  // Fractions of triangles whose smallest angle lies in [0, 10), [10, 20), [20, 30), [30, 40), [40, 50) and
  // [50, 60] degrees.
  std::array<double, 6> angle_share = {};
  double median_aspect = 0, aspect_p95 = 0;
};

TriangleQuality MeasureQuality(const IrradianceMesh& mesh);

}  // namespace penumbra
