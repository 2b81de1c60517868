// mesh/refinement/light_operator.h
//
// The light transport of a solved scene, kept as a matrix. With the sources and the nodes of the mesh fixed,
// irradiance is linear in the radiosities: R gives the irradiance at all nodes, and M the means of the
// interpolants over all sources. The light of other emittances e and reflectances rho is the solution of
// b = e + rho M R b, and takes products alone.

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
  const ElementForest& forest;  // of the triangulations: the solution's or a refinement of it
  std::span<const PatchTriangulation> triangulations;
  const PointIrradiance& exact;  // from the solution
  // The light of each emitter, as far as it is known: rows then also hold for each emitter alone.
  std::span<const EmitterLight> emitters;
  double tolerance = 0;  // of rows
};

class LightOperator {
 public:
  // Looks at each node of the mesh once. The operator keeps no reference to the input. REQUIRES:
  // in.exact.CanRecord().
  LightOperator(const OperatorInput& in, const ExecutionContext& context);
  // False if the construction was cancelled.
  bool Ready() const { return ready_; }

  // The light of a scene with the same patches as that of the solution: the irradiance of elements and
  // fragments, and the interpolants. The radiosities of the sources are within `cutoff` of their limit,
  // relative to the largest. Nothing if a patch sends light that sent none in the solution.
  std::optional<EmitterLight> LitBy(const Scene& other, double cutoff) const;

  // The memory of the matrix [bytes].
  std::size_t bytes() const;

 private:
  struct Term {
    double factor = 0;                        // [1]
    std::int32_t node = -1;                   // in sources_
    std::array<float, 3> moment = {0, 0, 0};  // of the node's slope [m]
  };
  // Rows of a sparse matrix.
  struct Matrix {
    std::vector<std::size_t> first = {0};
    std::vector<Term> terms;

    std::size_t rows() const { return first.size() - 1; }
    void Add(std::span<const Term> row);
    Rgb Product(std::size_t row, const SourceSet& light) const;  // at least 0
  };
  struct Weighted;

  void RecordNodes(const OperatorInput& in, SourceSet sources, const ExecutionContext& context);
  void AddMeans(const OperatorInput& in, const ExecutionContext& context);
  std::vector<Term> Joined(std::span<const Weighted> samples) const;
  std::vector<Rgb> ElementsOf(std::span<const Rgb> unknown) const;
  SourceLight LightOf(const Scene& scene, std::span<const Rgb> unknown) const;

  bool ready_ = false;
  ElementForest forest_;  // of the solution
  SourceSet sources_;
  IrradianceMesh mesh_;  // as recorded
  Matrix nodes_;         // R: a row for each sample of the mesh
  std::vector<std::array<std::uint32_t, 6>> samples_of_triangle_;
  // The unknowns are the irradiances of the fragments, and then of the leaves that are not cut.
  Matrix means_;  // M R: a row for each unknown
  std::vector<ElementId> leaf_of_unknown_;
  std::vector<double> area_of_unknown_;  // [m^2]
  std::size_t fragments_ = 0;
  std::vector<Rgb> start_;  // the irradiances of the unknowns in the solution
};

}  // namespace penumbra
