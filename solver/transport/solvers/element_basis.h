// solver/transport/solvers/element_basis.h
//
// Polynomials over an element of the dense solver, by their values at nodes inside it.

#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "solver/geometry/vec.h"

namespace penumbra {

// The degree of the radiosity over an element: in all, over triangles; in each of two parameters, over
// parallelograms.
enum class BasisDegree { kConstant = 0, kLinear = 1, kQuadratic = 2 };

// Functions that are 1 at their own node and 0 at the others. The nodes are those of rules for the mean over
// the element: Gauss and Legendre's, one, 2 x 2 or 3 x 3, on a parallelogram; of degree 1, 2 or 4, with one,
// three or six nodes, on a triangle (Strang and Fix 1973; Dunavant 1985).
class ElementBasis {
 public:
  static constexpr std::size_t kMost = 9;  // functions

  // REQUIRES: a triangle or a parallelogram; of other quadrilaterals only the constant degree.
  ElementBasis(std::span<const Vec3> polygon, BasisDegree degree);

  std::size_t size() const { return node_.size(); }
  const Vec3& Node(std::size_t i) const { return node_[i]; }  // [m]
  double Weight(std::size_t i) const { return weight_[i]; }   // of the rule for the mean; they add up to 1

  // The functions are combinations of monomials, which are cheaper where many values are added up.
  using Values = std::array<double, kMost>;
  void AddMonomials(const Vec3& position, double factor, Values& monomials) const;
  // What a sum of monomials over positions is for each function.
  Values FromMonomials(const Values& monomials) const;

  // The functions at a position in the element's plane.
  Values At(const Vec3& position) const;

 private:
  int degree_ = 0;
  bool tensor_ = false;
  Vec3 origin_, s_, t_;  // parameters: s . (position - origin) and t . (...)
  std::vector<Vec3> node_;
  std::vector<double> weight_;
  Eigen::MatrixXd coefficient_;  // of monomial m in function i
};

// Whether opposite sides of a quadrilateral are equal but for rounding of coordinates up to `extent` [m].
bool IsParallelogram(std::span<const Vec3> polygon, double extent);

}  // namespace penumbra
