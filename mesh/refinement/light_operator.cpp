#include "mesh/refinement/light_operator.h"

#include <algorithm>
#include <utility>

#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/row_sampler.h"
#include "mesh/refinement/covered_light.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/transport/solvers/anderson.h"

namespace penumbra {
namespace {

constexpr std::size_t kUnknownsATask = 16, kRowsOfProductATask = 256;
// Most rooms settle in ten steps. A room whose light does not settle in so many reflects nearly everything.
constexpr int kMostSteps = 1000;

// Sources with spreads that hold for the whole light, for what arrives (whose relative variation over a patch
// is that of the reflected light, whatever the reflectance), and for the light of each emitter.
SourceSet SourcesFor(const OperatorInput& in) {
  SourceSet sources = SourceSet::ForAnyLight(in.whole);
  SourceLight arriving(in.whole);
  arriving.element = in.whole.irradiance;
  for (std::size_t i = 0; i < in.whole.fragments.size(); ++i)
    arriving.fragment[i] = in.whole.fragments[i].irradiance;
  std::fill(arriving.emittance.begin(), arriving.emittance.end(), Rgb::Zero());
  sources.TakeSpreads(sources.WithLight(arriving.View()));
  for (const EmitterLight& light : in.emitters)
    sources.TakeSpreads(sources.WithLight(SourceLight(in.whole, light).View()));
  return sources;
}

}  // namespace

// A sample of the mesh with its weight in a mean.
struct LightOperator::Weighted {
  std::uint32_t sample;
  double weight;
};

void LightOperator::Matrix::Add(std::span<const Term> row) {
  terms.insert(terms.end(), row.begin(), row.end());
  first.push_back(terms.size());
}

Rgb LightOperator::Matrix::Product(std::size_t row, const SourceSet& light) const {
  std::array<double, 3> sum = {0, 0, 0};
  for (std::size_t i = first[row]; i < first[row + 1]; ++i) {
    const Term& term = terms[i];
    const SourceSet::NodeLight& node = light.LightOf(term.node);
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += term.factor * node.radiosity[c] + term.moment[0] * node.slope[3 * c] +
                term.moment[1] * node.slope[3 * c + 1] + term.moment[2] * node.slope[3 * c + 2];
  }
  return Rgb(sum[0], sum[1], sum[2]).max(0.0);
}

LightOperator::LightOperator(const OperatorInput& in, const ExecutionContext& context)
    : forest_(in.whole.forest), fragments_(in.whole.fragments.size()) {
  for (const Fragment& fragment : in.whole.fragments) {
    leaf_of_unknown_.push_back(fragment.leaf);
    area_of_unknown_.push_back(fragment.area);
    start_.push_back(fragment.irradiance);
  }
  for (const ElementId leaf : forest_.AllLeaves()) {
    if (!in.whole.FragmentsOf(leaf).empty()) continue;
    leaf_of_unknown_.push_back(leaf);
    area_of_unknown_.push_back(forest_[leaf].area);
    start_.push_back(in.whole.irradiance[static_cast<std::size_t>(leaf)]);
  }
  RecordNodes(in, SourcesFor(in), context);
  if (!context.Cancelled()) AddMeans(in, context);
  ready_ = !context.Cancelled();
}

// Finds the rows of all nodes.
void LightOperator::RecordNodes(const OperatorInput& in, SourceSet sources, const ExecutionContext& context) {
  const PointIrradiance exact = in.exact.WithSources(std::move(sources));
  const RowSampler rows(exact, in.tolerance, nullptr, /*keep=*/false);
  const auto many = [&](std::span<const PatchPoint> points, std::span<PointIrradianceResult> results) {
    if (context.Cancelled()) return;
    const std::vector<PointIrradianceResult> sampled = rows.At(points);
    std::vector<Term> row;
    for (std::size_t i = 0; i < points.size(); ++i) {
      row.clear();
      for (const FactorTerm& term : sampled[i].row->terms)
        row.push_back({term.factor, term.node, term.moment});
      nodes_.Add(row);
      results[i] = {sampled[i].irradiance, sampled[i].one_sided};
    }
  };
  const auto one = [&many](PatchId patch, const ReceiverPoint& at) {
    const PatchPoint point{patch, at};
    PointIrradianceResult result;
    many({&point, 1}, {&result, 1});
    return result;
  };
  BuiltMesh built = BuildIrradianceMesh(forest_.scene(), in.triangulations, InterpolantOrder::kQuadratic,
                                        IrradianceSampler(one, many), context);
  nodes_.terms.shrink_to_fit();
  mesh_ = std::move(built.mesh);
  samples_of_triangle_ = std::move(built.sample_numbers);
  sources_ = exact.sources();
}

// The weighted sum of the rows of samples, with one term for each node.
std::vector<LightOperator::Term> LightOperator::Joined(std::span<const Weighted> samples) const {
  struct Part {
    std::int32_t node;
    double factor;
    std::array<double, 3> moment;
  };
  std::vector<Part> parts;
  for (const auto& [sample, weight] : samples)
    for (std::size_t i = nodes_.first[sample]; i < nodes_.first[sample + 1]; ++i) {
      const Term& term = nodes_.terms[i];
      parts.push_back({term.node,
                       weight * term.factor,
                       {weight * term.moment[0], weight * term.moment[1], weight * term.moment[2]}});
    }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.node < b.node; });
  std::vector<Term> joined;
  for (std::size_t begin = 0, end = 0; begin < parts.size(); begin = end) {
    Part sum = parts[begin];
    for (end = begin + 1; end < parts.size() && parts[end].node == sum.node; ++end) {
      sum.factor += parts[end].factor;
      for (std::size_t axis = 0; axis < 3; ++axis) sum.moment[axis] += parts[end].moment[axis];
    }
    joined.push_back({sum.factor,
                      sum.node,
                      {static_cast<float>(sum.moment[0]), static_cast<float>(sum.moment[1]),
                       static_cast<float>(sum.moment[2])}});
  }
  return joined;
}

// Finds the rows of the means over all unknowns.
void LightOperator::AddMeans(const OperatorInput& in, const ExecutionContext& context) {
  const Scene& scene = forest_.scene();
  std::vector<std::uint32_t> first(in.triangulations.size() + 1, 0);
  // The triangles of each leaf of the solution.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> of_leaf(forest_.size(), {0, 0});
  for (std::size_t p = 0; p < in.triangulations.size(); ++p) {
    const PatchTriangulation& patch = in.triangulations[p];
    first[p + 1] = first[p] + static_cast<std::uint32_t>(patch.triangles.size());
    for (std::size_t l = 0; l < patch.leaves.size(); ++l) {
      ElementId leaf = patch.leaves[l];
      while (static_cast<std::size_t>(leaf) >= forest_.size() || !forest_[leaf].IsLeaf())
        leaf = in.forest[leaf].parent;
      std::pair<std::uint32_t, std::uint32_t>& range = of_leaf[static_cast<std::size_t>(leaf)];
      const std::uint32_t begin = first[p] + patch.first_triangle[l];
      if (range.first == range.second) range.first = begin;
      range.second = first[p] + patch.first_triangle[l + 1];
    }
  }
  std::vector<std::vector<Term>> rows(leaf_of_unknown_.size());
  ParallelFor(rows.size(), kUnknownsATask, [&](std::size_t u) {
    if (context.Cancelled()) return;
    const ElementId leaf = leaf_of_unknown_[u];
    const auto patch = static_cast<std::size_t>(forest_[leaf].patch);
    const Frame frame = PolygonFrame(scene.patches[patch].Vertices());
    const auto [begin, end] = of_leaf[static_cast<std::size_t>(leaf)];
    const CoveredLight light(mesh_, begin, end, frame);
    CoveredLight part = light;
    if (u < fragments_) {
      Polygon2 polygon;
      for (const Vec3& corner : in.whole.fragments[u].polygon) polygon.push_back(frame.ToPlane(corner));
      part = light.Within(polygon);
    }
    // A piece that is too narrow for triangles of its own has the mean of its leaf, or of its patch.
    if (!(part.area() > 0)) part = light;
    if (!(part.area() > 0)) part = CoveredLight(mesh_, first[patch], first[patch + 1], frame);
    if (!(part.area() > 0)) return;
    std::vector<Weighted> samples;
    for (const CoveredLight::SampleWeights& weights : part.MeanWeights())
      for (std::size_t k = 0; k < weights.weight.size(); ++k)
        samples.push_back({samples_of_triangle_[weights.triangle][k], weights.weight[k]});
    rows[u] = Joined(samples);
  });
  for (const std::vector<Term>& row : rows) means_.Add(row);
  means_.terms.shrink_to_fit();
}

// The irradiance of all elements.
std::vector<Rgb> LightOperator::ElementsOf(std::span<const Rgb> unknown) const {
  std::vector<Rgb> element(forest_.size(), Rgb::Zero());
  std::vector<double> area(forest_.size(), 0);
  const auto add = [&](ElementId to, double a, const Rgb& value) {
    element[static_cast<std::size_t>(to)] += a * value;
    area[static_cast<std::size_t>(to)] += a;
  };
  for (std::size_t u = 0; u < unknown.size(); ++u) add(leaf_of_unknown_[u], area_of_unknown_[u], unknown[u]);
  // Children have larger numbers than their parents.
  for (std::size_t e = element.size(); e-- > 0;) {
    if (area[e] > 0) element[e] /= area[e];
    const Element& own = forest_.elements()[e];
    if (own.parent != kNoElement) add(own.parent, own.area, element[e]);
  }
  return element;
}

SourceLight LightOperator::LightOf(const Scene& scene, std::span<const Rgb> unknown) const {
  SourceLight light;
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    light.emittance.push_back(scene.MaterialOf(static_cast<PatchId>(p)).emittance);
  light.element = ElementsOf(unknown);
  for (std::size_t e = 0; e < light.element.size(); ++e) {
    const Material& material = scene.MaterialOf(forest_.elements()[e].patch);
    light.element[e] = material.emittance + material.reflectance * light.element[e];
  }
  for (std::size_t f = 0; f < fragments_; ++f) {
    const Material& material = scene.MaterialOf(forest_[leaf_of_unknown_[f]].patch);
    light.fragment.push_back(material.emittance + material.reflectance * unknown[f]);
  }
  return light;
}

std::optional<EmitterLight> LightOperator::LitBy(const Scene& other, double cutoff) const {
  PENUMBRA_CHECK(ready_ && other.patches.size() == sources_.PatchCount());
  for (std::size_t p = 0; p < other.patches.size(); ++p) {
    const Material& material = other.MaterialOf(static_cast<PatchId>(p));
    const bool sends = (material.emittance > 0).any() || (material.reflectance > 0).any();
    if (sends && sources_.Tree(static_cast<PatchId>(p)).empty()) return std::nullopt;
  }
  std::vector<Rgb> unknown = start_;
  SourceSet sources = sources_;
  AndersonAcceleration faster(area_of_unknown_);
  double change = 1;
  for (int step = 0; step < kMostSteps && change > cutoff; ++step) {
    sources.TakeLight(LightOf(other, unknown).View());
    std::vector<Rgb> next(unknown.size());
    ParallelFor(next.size(), kUnknownsATask, [&](std::size_t u) { next[u] = means_.Product(u, sources); });
    double largest = 0, difference = 0;
    for (std::size_t u = 0; u < next.size(); ++u) {
      largest = std::max(largest, next[u].maxCoeff());
      difference = std::max(difference, (next[u] - unknown[u]).abs().maxCoeff());
    }
    change = largest > 0 ? difference / largest : 0;
    if (change > cutoff) faster.Improve(unknown, next);
    unknown = std::move(next);
    for (Rgb& value : unknown) value = value.max(0.0);
  }
  sources.TakeLight(LightOf(other, unknown).View());
  EmitterLight light;
  light.element = ElementsOf(unknown);
  light.fragment.assign(unknown.begin(), unknown.begin() + static_cast<std::ptrdiff_t>(fragments_));
  std::vector<Rgb> sample(nodes_.rows());
  ParallelFor(sample.size(), kRowsOfProductATask,
              [&](std::size_t i) { sample[i] = nodes_.Product(i, sources); });
  light.interpolant.resize(samples_of_triangle_.size());
  ParallelFor(light.interpolant.size(), kRowsOfProductATask, [&](std::size_t t) {
    std::array<Rgb, 6> six;
    for (std::size_t k = 0; k < 6; ++k) six[k] = sample[samples_of_triangle_[t][k]];
    light.interpolant[t] = QuadraticInterpolant::Quadratic(six);
  });
  return light;
}

std::size_t LightOperator::bytes() const {
  return (nodes_.terms.size() + means_.terms.size()) * sizeof(Term) +
         (nodes_.first.size() + means_.first.size()) * sizeof(std::size_t);
}

}  // namespace penumbra
