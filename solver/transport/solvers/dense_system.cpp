#include "solver/transport/solvers/dense_system.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>

#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/transport/solvers/congruent_pairs.h"
#include "solver/transport/sources/source_quadrature.h"
#include "solver/visibility/area/area_form_factor.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

constexpr std::size_t kRowGrain = 4;

void AddElements(const ElementForest& forest, BasisDegree degree, ElementId leaf, DenseSystem& system) {
  const auto add = [&](Polygon3 polygon) {
    ElementBasis basis(polygon, degree);
    const std::size_t first = system.element_of_unknown.size();
    system.element_of_unknown.resize(first + basis.size(), system.elements.size());
    const double area = VectorArea(polygon).norm();
    system.elements.push_back({leaf, std::move(polygon), area, std::move(basis), first});
  };
  const Element& element = forest[leaf];
  const Polygon3 whole(element.Vertices().begin(), element.Vertices().end());
  if (whole.size() == 3 || degree == BasisDegree::kConstant ||
      IsParallelogram(whole, forest.scene().patches[element.patch].extent)) {
    add(whole);
  } else {
    add({whole[0], whole[1], whole[2]});
    add({whole[0], whole[2], whole[3]});
  }
}

// The form factors between the constant elements of two patches that see each other.
class ConstantPairs {
 public:
  ConstantPairs(DenseSystem& system, const DenseOptions& options, std::vector<double>& row_error)
      : system_(system), scene_(system.forest.scene()), options_(options), row_error_(row_error) {}

  void Fill(PatchId a, PatchId b, std::span<const PatchId> blockers, const ExecutionContext& context) {
    const std::size_t first_a = system_.first_of_patch[a], first_b = system_.first_of_patch[b];
    const std::size_t count_a = system_.first_of_patch[a + 1] - first_a,
                      count_b = system_.first_of_patch[b + 1] - first_b;
    const PatchHierarchy between(scene_, {blockers.begin(), blockers.end()});
    AreaFormFactorOptions how;
    how.tolerance = options_.tolerance;
    how.max_points = options_.max_points;
    how.context = &context;
    const auto flux = [&](std::size_t i, std::size_t j) {
      const DenseElement &from = system_.elements[i], &to = system_.elements[j];
      const FormFactorEstimate estimate =
          AreaFormFactor(scene_, between, {a, from.polygon}, {b, to.polygon}, how);
      return FormFactorEstimate{from.area * estimate.factor, from.area * estimate.error};
    };
    // Congruent pairs share the form factor of the first such pair.
    std::vector<PairShape> shape(count_a * count_b);
    if (blockers.empty())
      ParallelFor(count_a, 1, [&](std::size_t i) {
        for (std::size_t j = 0; j < count_b; ++j)
          shape[i * count_b + j] = ShapeOfPair(system_.elements[first_a + i].polygon, scene_.patches[a],
                                               system_.elements[first_b + j].polygon, scene_.patches[b]);
      });
    std::vector<std::size_t> work;
    std::vector<FormFactorEstimate*> home;
    std::vector<FormFactorEstimate> own(shape.size());
    std::vector<const FormFactorEstimate*> result(shape.size());
    for (std::size_t k = 0; k < shape.size(); ++k) {
      FormFactorEstimate* place = &own[k];
      bool fresh = true;
      if (!shape[k].empty()) {
        const auto [at, inserted] = known_.try_emplace(std::move(shape[k]));
        place = &at->second;
        fresh = inserted;
      }
      result[k] = place;
      if (!fresh) continue;
      work.push_back(k);
      home.push_back(place);
    }
    ParallelFor(work.size(), 1, [&](std::size_t w) {
      if (!context.Cancelled()) *home[w] = flux(first_a + work[w] / count_b, first_b + work[w] % count_b);
    });
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const std::size_t i = first_a + k / count_b, j = first_b + k % count_b;
      Set(i, j, *result[k]);
      Set(j, i, *result[k]);
    }
  }

 private:
  void Set(std::size_t receiver, std::size_t source, const FormFactorEstimate& flux) {
    const double area = system_.elements[receiver].area;
    system_.transport(static_cast<Eigen::Index>(receiver), static_cast<Eigen::Index>(source)) =
        flux.factor / area;
    row_error_[receiver] += flux.error / area;
  }

  DenseSystem& system_;
  const Scene& scene_;
  const DenseOptions& options_;
  std::vector<double>& row_error_;
  std::map<PairShape, FormFactorEstimate> known_;
};

void AssembleConstant(DenseSystem& system, const PatchVisibility& visibility, const DenseOptions& options,
                      const ExecutionContext& context) {
  std::vector<double> row_error(system.size());
  ConstantPairs pairs(system, options, row_error);
  const auto count = static_cast<PatchId>(system.forest.scene().patches.size());
  for (PatchId a = 0; a < count && !context.Cancelled(); ++a) {
    context.Report("assemble", static_cast<double>(a) / count);
    for (const PatchPair& pair : visibility.SourcesOf(a))
      if (pair.source > a) pairs.Fill(a, pair.source, visibility.Blockers(pair), context);
  }
  system.form_factor_error = row_error.empty() ? 0 : *std::max_element(row_error.begin(), row_error.end());
}

void AssembleCollocated(DenseSystem& system, const PatchVisibility& visibility,
                        const ExecutionContext& context) {
  ParallelFor(system.elements.size(), kRowGrain, [&](std::size_t e) {
    const DenseElement& element = system.elements[e];
    for (std::size_t k = 0; k < element.basis.size() && !context.Cancelled(); ++k) {
      ReceiverPoint at;
      at.position = element.basis.Node(k);
      const PatchId patch = system.forest[element.leaf].patch;
      at.normal = system.forest.scene().patches[patch].normal;
      std::vector<double> row(system.size());
      AddTransport(system, visibility, patch, at, row);
      for (std::size_t j = 0; j < row.size(); ++j)
        system.transport(static_cast<Eigen::Index>(element.first + k), static_cast<Eigen::Index>(j)) = row[j];
    }
  });
  system.form_factor_error = kSourceQuadratureError;
}

}  // namespace

double DenseSystem::Weight(std::size_t unknown) const {
  const DenseElement& element = elements[element_of_unknown[unknown]];
  return element.area * element.basis.Weight(unknown - element.first);
}

void AddTransport(const DenseSystem& system, const PatchVisibility& visibility, PatchId patch,
                  const ReceiverPoint& at, std::span<double> row) {
  const Scene& scene = system.forest.scene();
  PointView view(scene, at);
  std::vector<SourceNode> nodes;
  for (const PatchPair& pair : visibility.SourcesOf(patch)) {
    if (!view.FaceSource(pair.source)) continue;
    for (std::size_t s = system.first_of_patch[pair.source]; s < system.first_of_patch[pair.source + 1];
         ++s) {
      const DenseElement& source = system.elements[s];
      nodes.clear();
      AddVisibleSourceNodes(view, source.polygon, visibility.Blockers(pair), patch, nodes);
      if (nodes.empty()) continue;
      ElementBasis::Values monomials{};
      for (const SourceNode& node : nodes) source.basis.AddMonomials(node.position, node.weight, monomials);
      const ElementBasis::Values values = source.basis.FromMonomials(monomials);
      for (std::size_t b = 0; b < source.basis.size(); ++b) row[source.first + b] += values[b];
    }
  }
}

DenseClosure MeasureClosure(const DenseSystem& system) {
  DenseClosure closure;
  if (system.size() == 0) return closure;
  const Eigen::VectorXd sums = system.transport.rowwise().sum();
  closure.least_row_sum = sums.minCoeff();
  closure.largest_row_sum = sums.maxCoeff();
  double skew = 0, all = 0;
  for (std::size_t j = 0; j < system.size(); ++j)
    for (std::size_t i = 0; i < system.size(); ++i) {
      const auto r = static_cast<Eigen::Index>(i), c = static_cast<Eigen::Index>(j);
      const double there = system.Weight(i) * system.transport(r, c),
                   back = system.Weight(j) * system.transport(c, r);
      skew += (there - back) * (there - back);
      all += there * there;
    }
  closure.reciprocity = all > 0 ? std::sqrt(skew / all) : 0;
  return closure;
}

std::size_t CountUnknowns(const ElementForest& forest, BasisDegree degree) {
  std::size_t count = 0;
  const std::size_t k = static_cast<std::size_t>(degree) + 1, triangle = k * (k + 1) / 2;
  for (const Element& element : forest.elements()) {
    if (!element.IsLeaf()) continue;
    const bool square = degree == BasisDegree::kConstant ||
                        IsParallelogram(element.Vertices(), forest.scene().patches[element.patch].extent);
    count += element.size == 3 ? triangle : square ? k * k : 2 * triangle;
  }
  return count;
}

DenseSystem AssembleDense(const ElementForest& forest, const PatchVisibility& visibility,
                          const DenseOptions& options, const ExecutionContext& context) {
  DenseSystem system;
  system.forest = forest;
  system.degree = options.degree;
  const std::size_t patches = forest.scene().patches.size();
  for (std::size_t p = 0; p < patches; ++p) {
    system.first_of_patch.push_back(system.elements.size());
    for (const ElementId leaf : forest.Leaves(static_cast<PatchId>(p)))
      AddElements(forest, options.degree, leaf, system);
  }
  system.first_of_patch.push_back(system.elements.size());
  const auto n = static_cast<Eigen::Index>(system.size());
  system.transport = Eigen::MatrixXd::Zero(n, n);
  if (options.degree == BasisDegree::kConstant)
    AssembleConstant(system, visibility, options, context);
  else
    AssembleCollocated(system, visibility, context);
  return context.Cancelled() ? DenseSystem{} : system;
}

ElementForest UniformForest(const Scene& scene, int divisions) {
  PENUMBRA_CHECK(divisions > 0 && std::has_single_bit(static_cast<unsigned>(divisions)));
  ElementForest forest(scene);
  for (int side = 1; side < divisions; side *= 2)
    for (const ElementId leaf : forest.AllLeaves()) forest.Subdivide(leaf);
  return forest;
}

}  // namespace penumbra
