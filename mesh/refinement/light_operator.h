// mesh/refinement/light_operator.h
//
// The light transport of a solved scene, stored as a matrix. If the sources and the mesh nodes are fixed,
// irradiance is linear in the radiosities b of the sources. The matrix R maps b to the irradiance at all mesh
// nodes, and M maps the irradiance at the nodes to the means of the interpolants over all sources. For other
// emittances e and reflectances rho, the radiosities b solve b = e + rho M R b, which takes products with the
// matrix and no form factors.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/refinement/emitter_light.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/factor_row.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/sources/source_set.h"

namespace penumbra {

struct OperatorInput {
  const RadiositySolution& whole;
  // The quadtrees whose leaves were triangulated: those of the solution, or finer ones.
  const ElementForest& forest;
  std::span<const PatchTriangulation> triangulations;
  const PointIrradiance& exact;  // exact irradiance from the solution
  // The light of each emitter alone, or an empty list. If the light of each emitter is given, the form
  // factors are accurate enough for the light of every single emitter.
  std::span<const EmitterLight> emitters;
  double tolerance = 0;  // the relative tolerance of the form factors of irradiance samples
};

class LightOperator {
 public:
  // Computes the form factors of each mesh node once. The LightOperator keeps no reference to its input.
  // REQUIRES: in.exact.CanRecord() is true.
  LightOperator(const OperatorInput& in, const ExecutionContext& context);
  // Ready() is false if the construction of the operator was cancelled.
  bool Ready() const { return ready_; }

  // Returns the light of `other`, a scene with the same patches as the solution's scene: the irradiance of
  // elements and fragments, and the interpolants. The iteration for the radiosities ends when no irradiance
  // changes by more than cutoff * (largest irradiance) in one step. The result is nullopt if a patch that
  // sent no light in the solution emits or reflects light in `other`.
  std::optional<EmitterLight> LitBy(const Scene& other, double cutoff) const;

  // The memory that the matrix occupies [bytes].
  std::size_t bytes() const;

 private:
  struct Term {
    double factor = 0;       // the coefficient of the radiosity of the source node [1]
    std::int32_t node = -1;  // the index of the source node in the source set
    // The coefficients of the gradient of radiosity over the source node [m].
    std::array<float, 3> moment = {0, 0, 0};
  };
  // Rows of a sparse matrix.
  struct Matrix {
    std::vector<std::size_t> first = {0};
    std::vector<Term> terms;

    std::size_t rows() const { return first.size() - 1; }
    void Add(std::span<const Term> row);
    // Returns the product of a row of the matrix and the radiosities in `light` [W/m^2], or 0 if the product
    // is negative.
    Rgb Product(std::size_t row, const SourceSet& light) const;
  };
  struct Weighted;

  void RecordNodes(const OperatorInput& in, SourceSet sources, const ExecutionContext& context);
  void AddMeans(const OperatorInput& in, const ExecutionContext& context);
  std::vector<Term> Joined(std::span<const Weighted> samples) const;
  std::vector<Rgb> ElementsOf(std::span<const Rgb> unknown) const;
  SourceLight LightOf(const Scene& scene, std::span<const Rgb> unknown) const;

  bool ready_ = false;
  ElementForest forest_;  // quadtrees of the solution
  SourceSet sources_;
  IrradianceMesh mesh_;  // the irradiance mesh that was given to the constructor
  Matrix nodes_;         // matrix from radiosities to irradiance at the samples of the mesh (R)
  std::vector<std::array<std::uint32_t, 6>> samples_of_triangle_;
  // The unknowns are the irradiances of the fragments (convex pieces of leaves), followed by the irradiances
  // of the leaves that have no fragments.
  Matrix means_;  // matrix from radiosities to the unknown irradiances (M R)
  std::vector<ElementId> leaf_of_unknown_;
  std::vector<double> area_of_unknown_;  // area of the leaf or fragment of each unknown [m^2]
  std::size_t fragments_ = 0;
  std::vector<Rgb> start_;  // the unknown irradiances, as they are in the solution
};

}  // namespace penumbra
