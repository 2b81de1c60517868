// solver/transport/solvers/element_basis.h
//
// Polynomials over an element of the dense radiosity solver, given by values at nodes inside the element.

#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "solver/geometry/vec.h"

namespace penumbra {

// The polynomial degree of the radiosity over an element: the total degree on triangles, the degree in each
// of the two parameters on parallelograms.
enum class BasisDegree { kConstant = 0, kLinear = 1, kQuadratic = 2 };

// Basis functions that are 1 at their own node and 0 at the other nodes. The nodes of the basis functions are
// the nodes of a quadrature rule for the mean over the element. Parallelograms have Gauss-Legendre rules with
// 1, 2 x 2 or 3 x 3 nodes. Triangles have rules of degree 1, 2 or 4 with 1, 3 or 6 nodes (Strang and Fix
// 1973; Dunavant 1985).
class ElementBasis {
 public:
  static constexpr std::size_t kMost = 9;  // largest number of basis functions of an element

  // REQUIRES: the polygon is a triangle, a parallelogram, or, for kConstant, any quadrilateral.
  ElementBasis(std::span<const Vec3> polygon, BasisDegree degree);

  std::size_t size() const { return node_.size(); }
  const Vec3& Node(std::size_t i) const { return node_[i]; }  // position of node i [m]
  // weight of node i in the quadrature rule for the mean; all weights add up to 1
  double Weight(std::size_t i) const { return weight_[i]; }

  // Adds factor * (monomials at the position) to `monomials`. To sum basis functions over many positions, it
  // is faster to sum monomials and to convert the sum with FromMonomials().
  using Values = std::array<double, kMost>;
  void AddMonomials(const Vec3& position, double factor, Values& monomials) const;
  // Converts weighted sums of monomials over some positions to the same weighted sums of basis functions.
  Values FromMonomials(const Values& monomials) const;

  // The values of the basis functions at a position in the element's plane.
  Values At(const Vec3& position) const;

 private:
  int degree_ = 0;
  bool tensor_ = false;
  // parameters of a position: dot(s_, position - origin_) and dot(t_, position - origin_)
  Vec3 origin_, s_, t_;
  std::vector<Vec3> node_;
  std::vector<double> weight_;
  Eigen::MatrixXd coefficient_;  // entry (m, i) is the coefficient of monomial m in basis function i
};

// True if opposite sides of the quadrilateral are equal up to rounding. `extent` [m] is an upper bound of the
// absolute values of the vertices' coordinates.
bool IsParallelogram(std::span<const Vec3> polygon, double extent);

}  // namespace penumbra
