// solver/visibility/point/form_factor_batch.h
//
// Form factors of one point to many unoccluded quadrilaterals at once: the inner loop of IrradianceAtPoint().

#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Convex polygons of three or four vertices as a structure of arrays; a triangle repeats its last vertex.
class PolygonBatch {
 public:
  std::size_t size() const { return coordinate_[0].size(); }
  void Add(std::span<const Vec3> polygon);
  // Adds polygon i of another batch.
  void AddFrom(const PolygonBatch& other, std::size_t i);
  void Clear();
  // The coordinates of all k-th vertices along an axis.
  const double* Coordinates(std::size_t k, std::size_t axis) const {
    return coordinate_[3 * k + axis].data();
  }
  // All of them from polygon `first` on: entry 3 k + axis.
  std::array<const double*, 12> Columns(std::size_t first) const;

 private:
  std::array<std::vector<double>, 12> coordinate_;
};

// Writes out[i - begin], the form factor of the point at `position` with unit normal `normal` to polygon i of
// the batch, for begin <= i < end, within kFormFactorError of the value. REQUIRES: the polygons lie above the
// point's horizon and turn their fronts to it.
//
// Vectorised, with the width chosen when the program starts; the results are the same for every width.
void FormFactors(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
                 const Vec3& normal, double* out);

// The sums over edges alone, which cancel in part where a polygon is seen flatly or lies near the horizon. A
// polygon that is small as seen is summed about its first vertex, which keeps its digits however small it is
// (thesis_notes/derivations.md, "Small polygons").
class FormFactorSums {
 public:
  // The same polygons, point and requirements as of FormFactors().
  void Find(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
            const Vec3& normal);

  // The form factor to the i-th of these polygons.
  double Factor(std::size_t i) const { return factor_[i]; }
  // The sum of the sizes of what was added to make it: the factor is within kFormFactorError of
  // SizeAdded(i) / (2 pi kFormFactorCancellation), or of its value where that is more.
  double SizeAdded(std::size_t i) const { return size_added_[i]; }

  void Clear();

 private:
  std::vector<double> factor_, size_added_;
  // Polygons that are not small, copied side by side.
  std::vector<std::size_t> large_;
  PolygonBatch large_polygons_;
  std::vector<double> large_factor_, large_size_added_;
};
// One of the factors, by quadrature, which does not cancel.
double FormFactorByQuadrature(const PolygonBatch& batch, std::size_t i, const Vec3& position,
                              const Vec3& normal);

}  // namespace penumbra
