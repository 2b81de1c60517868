// solver/transport/solvers/dense_system.h
//
// The radiosity equation on the leaves of a forest as a dense matrix: what the hierarchical solver is
// measured by.
//
// Constant elements are Galerkin's: the form factors are those of areas, so that the light that leaves one
// element is the light that arrives at the others, and the mean irradiance of a closed room is right on any
// mesh. Linear and quadratic elements are collocated at Gauss nodes inside the elements: a row is then an
// integral over sources alone, and where walls meet none of its nodes lies on the common edge. Rows of a
// closed room add up to 1 all the same, and the irradiance that the solution sends to other points converges
// faster than the solution does (iterated collocation; Atkinson, The numerical solution of integral equations
// of the second kind, 1997). What collocation gives up is reciprocity, which holds to the order of the
// method. Nothing is normalised.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/solvers/element_basis.h"
#include "solver/visibility/pair/patch_visibility.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

struct DenseOptions {
  BasisDegree degree = BasisDegree::kConstant;
  int divisions = 4;  // of each patch's sides into elements: a power of two (UniformForest)
  // Of form factors between constant elements, where something stands between: the relative error that is
  // asked for, and the points that a pair may cost (AreaFormFactorOptions). Others are exact but for
  // rounding.
  double tolerance = 1e-7;
  std::size_t max_points = 100'000;
};

// A leaf, or one of the two triangles of a leaf that is no parallelogram, if the degree is not constant.
struct DenseElement {
  ElementId leaf = kNoElement;
  Polygon3 polygon;  // [m]
  double area = 0;   // [m^2]
  ElementBasis basis;
  std::size_t first = 0;  // its first unknown; there are basis.size()
};

struct DenseSystem {
  ElementForest forest;
  BasisDegree degree = BasisDegree::kConstant;
  std::vector<DenseElement> elements;           // by patch, then in depth-first order of the leaves
  std::vector<std::size_t> first_of_patch;      // into elements, and one past the last
  std::vector<std::size_t> element_of_unknown;  // into elements
  // Irradiance of the unknown of the row from unit radiosity of that of the column [1]: of a constant element
  // its mean, else at its node.
  Eigen::MatrixXd transport;
  double form_factor_error = 0;  // the largest sum over a row of what form factors may be off by

  std::size_t size() const { return element_of_unknown.size(); }
  PatchId PatchOf(std::size_t unknown) const {
    return forest[elements[element_of_unknown[unknown]].leaf].patch;
  }
  // The area that an unknown stands for [m^2]; they add up to the scene's.
  double Weight(std::size_t unknown) const;
};

// How well the matrix keeps what light must: sums of rows are 1 in closed rooms, and weight x transport is
// symmetric.
struct DenseClosure {
  double least_row_sum = 1, largest_row_sum = 0;
  double reciprocity =
      0;  // |W T - (W T)'| / |W T|, in Frobenius' norm; 0 by construction of constant elements
};
DenseClosure MeasureClosure(const DenseSystem& system);

// How many unknowns the leaves of a forest have.
std::size_t CountUnknowns(const ElementForest& forest, BasisDegree degree);

// REQUIRES: the visibility is that of the forest's scene. Parallel, and the same for any number of threads.
// Empty, with no unknowns, if cancelled.
DenseSystem AssembleDense(const ElementForest& forest, const PatchVisibility& visibility,
                          const DenseOptions& options, const ExecutionContext& context);

// Adds to `row`, an entry an unknown, the irradiance at a point on the front of a patch from unit radiosity
// of each unknown [1]: exact past whatever blocks, but for kSourceQuadratureError. Safe from any
// thread.
void AddTransport(const DenseSystem& system, const PatchVisibility& visibility, PatchId patch,
                  const ReceiverPoint& at, std::span<double> row);

// Every patch of the scene cut into divisions x divisions elements. REQUIRES: a power of two, at most
// 2^kMaxLevel.
ElementForest UniformForest(const Scene& scene, int divisions);

}  // namespace penumbra
