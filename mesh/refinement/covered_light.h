// mesh/refinement/covered_light.h
//
// The irradiance interpolants of a mesh within a convex polygon whose sides need not follow edges of the
// mesh.

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
  // Takes the triangles of `mesh` with indices in [first, end). The triangles of a CoveredLight lie on one
  // patch, whose plane coordinates are defined by `frame`.
  CoveredLight(const IrradianceMesh& mesh, std::uint32_t first, std::uint32_t end, const Frame& frame);

  // Clips the triangles to the convex, counter-clockwise polygon. Clipped triangles so small that only
  // rounding explains them are omitted, because they lie on the other side of a contact, where the irradiance
  // is different.
  CoveredLight Within(std::span<const Vec2> polygon) const;

  // The total area of the clipped triangles [m^2].
  double area() const { return area_; }
  // The exact mean of the interpolants over the clipped triangles [W/m^2]. REQUIRES: area() > 0.
  Rgb Mean() const;
  // MeanWeights() expresses Mean() as a weighted sum over the irradiance samples of the mesh. Each
  // SampleWeights holds the index of a triangle in the mesh, and the weights of the triangle's six samples in
  // the order of kSampleAt. All weights in the result of MeanWeights() together add up to 1. REQUIRES: area()
  // > 0.
  struct SampleWeights {
    std::uint32_t triangle = 0;
    std::array<double, 6> weight = {};
  };
  std::vector<SampleWeights> MeanWeights() const;
  // For each channel, the largest difference between `mean` and the interpolants, at the vertices and the
  // edge midpoints of the clipped triangles [W/m^2].
  Rgb Deviation(const Rgb& mean) const;
  // The area, before clipping, of the largest triangle that overlaps the polygon [m^2].
  double LargestTriangle() const;

 private:
  struct Triangle {
    std::uint32_t number;  // the index of the triangle in the irradiance mesh
    Vec2 origin;
    Eigen::Matrix2d to_barycentric;
    double area;  // area of the whole triangle [m^2]
    const QuadraticInterpolant* irradiance;

    Vec2 BarycentricOf(const Vec2& p) const { return to_barycentric * (p - origin); }
    Rgb At(const Vec2& p) const;
  };
  struct Piece {
    std::uint32_t triangle;    // index of the triangle in *triangles_
    std::uint32_t first, end;  // the corners of the piece are corners_[first] to corners_[end - 1]
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
