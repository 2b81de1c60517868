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

// A list of convex polygons of three or four vertices, stored as a structure of arrays. A triangle is stored
// with a fourth vertex that repeats the third.
class PolygonBatch {
 public:
  std::size_t size() const { return coordinate_[0].size(); }
  void Add(std::span<const Vec3> polygon);
  // Appends a copy of polygon i of another batch.
  void AddFrom(const PolygonBatch& other, std::size_t i);
  void Clear();
  // The array of the coordinates along `axis` of vertex k, for all polygons of the batch.
  const double* Coordinates(std::size_t k, std::size_t axis) const {
    return coordinate_[3 * k + axis].data();
  }
  // Pointers into the coordinate arrays at polygon `first`: entry 3 k + axis points to the coordinate `axis`
  // of vertex k.
  std::array<const double*, 12> Columns(std::size_t first) const;

 private:
  std::array<std::vector<double>, 12> coordinate_;
};

// Sets out[i - begin] to the form factor of the point at `position` with unit normal `normal` to polygon i of
// the batch, for begin <= i < end. The relative error of each form factor is at most kFormFactorError.
// REQUIRES: the polygons lie above the point's horizon, and their fronts face the point.
//
// FormFactors() is vectorised; the program chooses the vector width when it starts. The form factors are the
// same for every SIMD vector width.
void FormFactors(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
                 const Vec3& normal, double* out);

// Computes form factors by edge sums only, without quadrature. Edge sums lose digits for polygons seen at a
// grazing angle or near the horizon. For polygons with a small apparent size, vertices are taken relative to
// the first vertex, so that the edge sum has no cancellation (thesis_notes/derivations.md, "Small polygons").
class FormFactorSums {
 public:
  // Computes the form factors as edge sums; the parameters and requirements are those of FormFactors().
  void Find(const PolygonBatch& batch, std::size_t begin, std::size_t end, const Vec3& position,
            const Vec3& normal);

  // The form factor of the point to polygon begin + i of the batch.
  double Factor(std::size_t i) const { return factor_[i]; }
  // The sum of the absolute values of the terms of the edge sum for polygon begin + i. The error of Factor(i)
  // is at most kFormFactorError * max(Factor(i), SizeAdded(i) / (2 pi kFormFactorCancellation)).
  double SizeAdded(std::size_t i) const { return size_added_[i]; }

  void Clear();

 private:
  std::vector<double> factor_, size_added_;
  // Compact copies of the polygons whose apparent size is not small.
  std::vector<std::size_t> large_;
  PolygonBatch large_polygons_;
  std::vector<double> large_factor_, large_size_added_;
};
// The form factor of the point to polygon i of the batch, by quadrature, which has no cancellation.
double FormFactorByQuadrature(const PolygonBatch& batch, std::size_t i, const Vec3& position,
                              const Vec3& normal);

}  // namespace penumbra
