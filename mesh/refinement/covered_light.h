// mesh/refinement/covered_light.h
//
// The interpolants of a mesh within a convex polygon that does not follow the edges of the mesh.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/geometry/polygon.h"

namespace penumbra {

class CoveredLight {
 public:
  // The triangles [first, end) of a mesh, which lie on one patch with the frame `frame`.
  CoveredLight(const IrradianceMesh& mesh, std::uint32_t first, std::uint32_t end, const Frame& frame);

  // The part within the convex, counter-clockwise polygon. Omits pieces that are so small that only rounding
  // can have put them there: pieces on the other side of a contact.
  CoveredLight Within(std::span<const Vec2> polygon) const;

  // The area of the pieces [m^2].
  double area() const { return area_; }
  // The exact mean of the interpolants over the pieces [W/m^2]. REQUIRES: area() > 0.
  Rgb Mean() const;
  // Mean() as a sum over samples: for each triangle with a piece, its number in the mesh, and the weights of
  // its six samples in the order of kSampleAt. The weights add up to 1. REQUIRES: area() > 0.
  struct SampleWeights {
    std::uint32_t triangle = 0;
    std::array<double, 6> weight = {};
  };
  std::vector<SampleWeights> MeanWeights() const;
  // For each channel, the largest difference between `mean` and the interpolants, at the vertices of the
  // pieces and at the midpoints of their edges [W/m^2].
  Rgb Deviation(const Rgb& mean) const;
  // The area of the largest triangle that has a piece [m^2].
  double LargestTriangle() const;

 private:
  struct Triangle {
    std::uint32_t number;  // in the mesh
    Vec2 origin;
    Eigen::Matrix2d to_barycentric;
    double area;  // [m^2]
    const QuadraticInterpolant* irradiance;

    Vec2 BarycentricOf(const Vec2& p) const { return to_barycentric * (p - origin); }
    Rgb At(const Vec2& p) const;
  };
  struct Piece {
    std::uint32_t triangle;    // index in *triangles_
    std::uint32_t first, end;  // range in corners_
    double area;
  };

  CoveredLight() = default;
  std::span<const Vec2> Corners(const Piece& piece) const {
    return {corners_.data() + piece.first, corners_.data() + piece.end};
  }
  void Add(std::uint32_t triangle, std::span<const Vec2> polygon, double area);

  std::shared_ptr<const std::vector<Triangle>> triangles_;
  std::vector<Piece> pieces_;
  std::vector<Vec2> corners_;
  double area_ = 0;
};

}  // namespace penumbra
