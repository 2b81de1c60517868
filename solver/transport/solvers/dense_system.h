// solver/transport/solvers/dense_system.h
//
// The radiosity equation as a dense matrix over the leaves of all quadtrees: the reference for the
// hierarchical solver.
//
// Constant elements use the Galerkin method with form factors between areas: no light is lost between leaving
// one element and arriving at another, and the mean irradiance of a closed room is correct on every mesh.
// Linear and quadratic elements use collocation at Gauss nodes inside the elements: a row of the matrix is an
// integral over sources only, and no node lies on an edge where walls meet. With collocation, each row of the
// matrix of a closed room adds up to 1. At points other than the nodes, the irradiance that is computed from
// the solved radiosity converges faster than the radiosity itself (iterated collocation; Atkinson, The
// numerical solution of integral equations of the second kind, 1997). With collocation, reciprocity holds
// only to the order of the method. No row of form factors is normalised to the sum 1.

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
  int divisions = 4;  // number of elements along each side of a patch: a power of two (UniformForest)
  // For form factors between constant elements with blockers, `tolerance` limits the relative error, and
  // `max_points` limits the number of points for one pair of elements (AreaFormFactorOptions). Form factors
  // without blockers, and those of linear and quadratic elements, are exact up to rounding.
  double tolerance = 1e-7;
  std::size_t max_points = 100'000;
  // If true, the matrix, which takes 8 bytes * (number of unknowns)^2, is kept after the solve, for
  // LightSolver::LitAs().
  bool keep_matrix = false;
};

// An element of the dense system is a leaf of a quadtree. If the leaf is a quadrilateral but no
// parallelogram, and the basis is linear or quadratic, the leaf is cut into two triangular elements.
struct DenseElement {
  ElementId leaf = kNoElement;
  Polygon3 polygon;  // vertices of the element [m]
  double area = 0;   // area of the element [m^2]
  ElementBasis basis;
  std::size_t first = 0;  // number of the element's first unknown; the element has basis.size() unknowns
};

struct DenseSystem {
  ElementForest forest;
  BasisDegree degree = BasisDegree::kConstant;
  // All elements, ordered by patch, then by depth-first order of the leaves.
  std::vector<DenseElement> elements;
  // index of each patch's first element; the last entry is the number of elements
  std::vector<std::size_t> first_of_patch;
  std::vector<std::size_t> element_of_unknown;  // for each unknown, the index of its element in `elements`
  // transport(i, j) is the irradiance of unknown i for unit radiosity of unknown j [1]. The irradiance of an
  // unknown is the mean over the element for constant elements, and the value at the node for linear and
  // quadratic elements.
  Eigen::MatrixXd transport;
  // The largest sum, over all rows of the matrix, of the errors of a row's form factors.
  double form_factor_error = 0;

  std::size_t size() const { return element_of_unknown.size(); }
  PatchId PatchOf(std::size_t unknown) const {
    return forest[elements[element_of_unknown[unknown]].leaf].patch;
  }
  // The area that an unknown represents [m^2]. The areas of all unknowns add up to the area of the scene.
  double Weight(std::size_t unknown) const;
};

// Measures how well the system satisfies two properties of the exact operator: rows of `transport` sum to 1
// in closed rooms, and weight * transport is symmetric.
struct DenseClosure {
  double least_row_sum = 1, largest_row_sum = 0;
  // The value |W T - (W T)'| / |W T| in the Frobenius norm, where W T is weight * transport; 0 for constant
  // elements by construction.
  double reciprocity = 0;
};
DenseClosure MeasureClosure(const DenseSystem& system);

// The number of unknowns of the dense system on the leaves of all quadtrees.
std::size_t CountUnknowns(const ElementForest& forest, BasisDegree degree);

// Computes the dense system with several threads; the matrix does not depend on the number of threads. If the
// computation is cancelled (ExecutionContext), the system has no unknowns. REQUIRES: `visibility` belongs to
// the scene of `forest`.
DenseSystem AssembleDense(const ElementForest& forest, const PatchVisibility& visibility,
                          const DenseOptions& options, const ExecutionContext& context);

// Adds to row[i] the irradiance at a point on the front of a patch for unit radiosity of unknown i [1].
// Visibility is exact; the integration over the sources has an error of at most kSourceQuadratureError. Any
// thread may call AddTransport().
void AddTransport(const DenseSystem& system, const PatchVisibility& visibility, PatchId patch,
                  const ReceiverPoint& at, std::span<double> row);

// The quadtrees of all patches of the scene, each patch cut into divisions x divisions elements. REQUIRES:
// `divisions` is a power of two, at most 2^kMaxLevel.
ElementForest UniformForest(const Scene& scene, int divisions);

}  // namespace penumbra
