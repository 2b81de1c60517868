// mesh/interpolants/midpoint_prediction.h
//
// Predicts the irradiance at the midpoints of triangle edges from the irradiance at the vertices of a mesh.
// Where the irradiance is smooth, the prediction saves three of four samples.

#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "mesh/interpolants/corner_sheets.h"
#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

class MidpointPrediction {
 public:
  // corner[t][k] is the irradiance at vertex k of triangle t [W/m^2]. The constructor estimates the gradient
  // of the irradiance at each vertex, separately for each sheet (the triangles at the vertex on one side of
  // all discontinuities). The gradient of a sheet is the area-weighted mean of the gradients of the linear
  // functions on the triangles of the sheet. The constructor arguments must outlive the MidpointPrediction.
  MidpointPrediction(const IrradianceMesh& mesh, const CornerSheets& sheets,
                     std::span<const std::array<Rgb, 3>> corner);

  struct Midpoint {
    // The predicted irradiance, from the cubic along the edge that has the values and gradients at both ends
    // [W/m^2].
    Rgb value;
    Rgb bend;  // (irradiance at the midpoint of an edge) - (mean of the irradiances at both ends) [W/m^2]
  };
  // The prediction for the midpoint of edge k of triangle t, with the gradients on the triangle's side of
  // discontinuities.
  Midpoint At(std::size_t t, std::size_t k) const;

 private:
  const IrradianceMesh& mesh_;
  const CornerSheets& sheets_;
  std::span<const std::array<Rgb, 3>> corner_;
  // The gradient of the irradiance on each sheet, with one row for each channel [W/m^3].
  std::vector<Eigen::Matrix3d> gradient_;
};

}  // namespace penumbra
