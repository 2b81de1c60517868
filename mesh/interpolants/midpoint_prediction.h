// mesh/interpolants/midpoint_prediction.h
//
// Predicts the irradiance at midpoints of edges from the samples at the vertices of a mesh. Where light is
// smooth, the prediction spares three of four samples.

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
  // of the irradiance at each vertex: the area-weighted mean of the gradients of the linear functions on the
  // triangles of a sheet. The arguments must
  // outlive the object.
  MidpointPrediction(const IrradianceMesh& mesh, const CornerSheets& sheets,
                     std::span<const std::array<Rgb, 3>> corner);

  struct Midpoint {
    Rgb value;  // of the cubic with the values and gradients of both ends [W/m^2]
    Rgb bend;   // value - (mean of both ends) [W/m^2]
  };
  // The midpoint of edge k of triangle t, as seen from the triangle.
  Midpoint At(std::size_t t, std::size_t k) const;

 private:
  const IrradianceMesh& mesh_;
  const CornerSheets& sheets_;
  std::span<const std::array<Rgb, 3>> corner_;
  std::vector<Eigen::Matrix3d> gradient_;  // by sheet; one row for each channel [W/m^3]
};

}  // namespace penumbra
