// solver/transport/solvers/dense_system.h
//
// The radiosity equation on the leaves of a forest as a dense matrix: the reference for the hierarchical
// solver.
//
// Constant elements use the Galerkin method with form factors between areas: the light that leaves an element
// equals the light that arrives at the others, and the mean irradiance of a closed room is correct on every
// mesh. Linear and quadratic elements use collocation at Gauss nodes inside the elements: a row is an
// integral over sources only, and no node lies on an edge where walls meet. With collocation, too, rows of a
// closed room add up to 1. The irradiance that is computed from the solution at other points converges faster
// than the solution itself (iterated collocation; Atkinson, The numerical solution of integral equations of
// the second kind, 1997). With collocation, reciprocity holds only to the order of the method. No form factor
// is normalised.

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
  int divisions = 4;  // elements along each side of a patch: a power of two (UniformForest)
  // Limits for the form factors between constant elements with blockers: the relative error, and the number
  // of points for one pair (AreaFormFactorOptions). All other form factors are exact up to rounding.
  double tolerance = 1e-7;
  std::size_t max_points = 100'000;
  bool keep_matrix = false;  // after the solve, for LightSolver::LitAs(): 8 bytes * (unknowns)^2
};

// An element is a leaf of the forest, or, if the degree is not constant and the leaf is a quadrilateral but
// no parallelogram, one of two triangles of the leaf.
struct DenseElement {
  ElementId leaf = kNoElement;
  Polygon3 polygon;  // [m]
  double area = 0;   // [m^2]
  ElementBasis basis;
  std::size_t first = 0;  // its first unknown; it has basis.size() unknowns
};

struct DenseSystem {
  ElementForest forest;
  BasisDegree degree = BasisDegree::kConstant;
  std::vector<DenseElement> elements;           // by patch, then in depth-first order of the leaves
  std::vector<std::size_t> first_of_patch;      // in `elements`, and one past the last
  std::vector<std::size_t> element_of_unknown;  // index in `elements`
  // transport(i, j) is the irradiance of unknown i for unit radiosity of unknown j [1]. For constant
  // elements, the irradiance of an unknown is the mean over the element; otherwise, it is the value at the
  // node.
  Eigen::MatrixXd transport;
  double form_factor_error = 0;  // the largest sum over a row of the form factors' errors

  std::size_t size() const { return element_of_unknown.size(); }
  PatchId PatchOf(std::size_t unknown) const {
    return forest[elements[element_of_unknown[unknown]].leaf].patch;
  }
  // The area of an unknown [m^2]. All weights add up to the area of the scene.
  double Weight(std::size_t unknown) const;
};

// Measures how well the system satisfies two properties of the exact operator: rows of `transport` sum to 1
// in closed rooms, and weight * transport is symmetric.
struct DenseClosure {
  double least_row_sum = 1, largest_row_sum = 0;
  double reciprocity =
      0;  // |W T - (W T)'| / |W T| in the Frobenius norm; 0 for constant elements by construction
};
DenseClosure MeasureClosure(const DenseSystem& system);

// The number of unknowns on the leaves of a forest.
std::size_t CountUnknowns(const ElementForest& forest, BasisDegree degree);

// Computes the dense system, with several threads; the result does not depend on their number. The system has
// no unknowns if the context is cancelled. REQUIRES: the visibility is that of the forest's scene.
DenseSystem AssembleDense(const ElementForest& forest, const PatchVisibility& visibility,
                          const DenseOptions& options, const ExecutionContext& context);

// Adds to row[i] the irradiance at a point on the front of a patch for unit radiosity of unknown i [1].
// Visibility is exact; the only error of the integration is kSourceQuadratureError. May be called from any
// thread.
void AddTransport(const DenseSystem& system, const PatchVisibility& visibility, PatchId patch,
                  const ReceiverPoint& at, std::span<double> row);

// All patches of the scene, each cut into divisions x divisions elements. REQUIRES: `divisions` is a power of
// two, at most 2^kMaxLevel.
ElementForest UniformForest(const Scene& scene, int divisions);

}  // namespace penumbra
