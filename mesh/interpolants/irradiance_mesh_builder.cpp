#include "mesh/interpolants/irradiance_mesh_builder.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/leaf_margins.h"
#include "mesh/interpolants/corner_sheets.h"
#include "mesh/interpolants/midpoint_prediction.h"
#include "solver/base/check.h"
#include "solver/scene/tolerances.h"
#include "solver/transport/sources/error_floors.h"

namespace penumbra {
namespace {

// An index in the list of samples, for one sample of a triangle.
using Slot = std::uint32_t;

struct Node {
  PatchId patch = kNoPatch;
  std::uint32_t triangle = 0;  // the triangle that needs it, in IrradianceMesh::triangles
  std::uint8_t sample = 0;     // number in the triangle, in the order of kSampleAt
};

// The triangles and vertices of all patches, without interpolants.
IrradianceMesh JoinPatches(std::span<const PatchTriangulation> patches) {
  IrradianceMesh mesh;
  for (const PatchTriangulation& patch : patches) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), patch.positions.begin(), patch.positions.end());
    for (const PatchTriangulation::Triangle& t : patch.triangles) {
      IrradianceMesh::Triangle joined;
      joined.patch = patch.patch;
      for (int k = 0; k < 3; ++k) {
        joined.vertex[k] = base + t.vertex[k];
        joined.discontinuity[k] = t.line[k] != kNoLine;
      }
      mesh.triangles.push_back(joined);
    }
  }
  return mesh;
}

// All nodes of a mesh, and the nodes of each triangle.
struct Nodes {
  std::vector<Node> first;  // per node, the first triangle that needs it
  std::vector<std::array<Slot, 6>> of_triangle;
};

Nodes NumberNodes(const IrradianceMesh& mesh, bool midpoints) {
  Nodes nodes;
  constexpr Slot kNone = ~Slot{0};
  std::vector<Slot> at_vertex(mesh.positions.size(), kNone);
  std::unordered_map<std::uint64_t, Slot> at_edge;
  if (midpoints) at_edge.reserve(2 * mesh.triangles.size());
  nodes.of_triangle.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const IrradianceMesh::Triangle& triangle = mesh.triangles[t];
    const auto add = [&](int sample) {
      nodes.first.push_back(
          {triangle.patch, static_cast<std::uint32_t>(t), static_cast<std::uint8_t>(sample)});
      return static_cast<Slot>(nodes.first.size() - 1);
    };
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t v = triangle.vertex[k], w = triangle.vertex[(k + 1) % 3];
      if (at_vertex[v] == kNone) at_vertex[v] = add(2 * k);
      nodes.of_triangle[t][2 * k] = at_vertex[v];
      if (!midpoints) continue;
      const auto [place, added] = at_edge.try_emplace(std::min(v, w) << 32 | std::max(v, w), kNone);
      if (added) place->second = add(2 * k + 1);
      nodes.of_triangle[t][2 * k + 1] = place->second;
    }
  }
  return nodes;
}

double Uncertainty(const Patch& patch, double gap) { return std::max(kOnLine * SnapDistance(patch), gap); }

// Per patch, the distance within which vertices are one place [m]. If a vertex is near a plane, it is farther
// from the line where this plane meets the patch, by the factor 1 / (sine of the angle between the two): 4
// for 15 degrees.
std::vector<double> OnePlace(const Scene& scene) {
  constexpr double kSkew = 4;
  const double gap = ContactGap(scene);
  std::vector<double> widths;
  for (const Patch& patch : scene.patches) widths.push_back(kSkew * Uncertainty(patch, gap));
  return widths;
}

class Sampling {
 public:
  struct Sides {
    const FlatTriangles* flat = nullptr;
    const CornerSheets* sheets = nullptr;
  };

  // Without `sides`, no vertices can be sampled.
  Sampling(const Scene& scene, const IrradianceMesh& mesh, const Sides& sides,
           const IrradianceSampler& sampler, SampleCache* cache, const ExecutionContext& context)
      : mesh_(mesh), sides_(sides), sampler_(sampler), cache_(cache), context_(context), scene_(scene) {
    const double gap = ContactGap(scene);
    for (const Patch& patch : scene.patches) uncertainty_.push_back(Uncertainty(patch, gap));
  }

  // The samples at the nodes, for the triangles that the nodes name.
  std::vector<PointIrradianceResult> Evaluate(std::span<const Node> nodes, double done_before,
                                              double done_after) {
    std::vector<PointIrradianceResult> results(nodes.size());
    std::vector<std::size_t> unknown;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const PointIrradianceResult* known = cache_ ? cache_->Find(nodes[i].patch, At(nodes[i])) : nullptr;
      if (known)
        results[i] = *known;
      else
        unknown.push_back(i);
    }
    // Batches let one thread report progress.
    constexpr std::size_t kBatch = 1 << 14;
    std::vector<PatchPoint> points;
    std::vector<PointIrradianceResult> found;
    for (std::size_t begin = 0; begin < unknown.size() && !context_.Cancelled(); begin += kBatch) {
      const std::size_t size = std::min(kBatch, unknown.size() - begin);
      context_.Report("interpolate", done_before + (done_after - done_before) * static_cast<double>(begin) /
                                                       static_cast<double>(unknown.size()));
      points.clear();
      for (std::size_t k = begin; k < begin + size; ++k)
        points.push_back({nodes[unknown[k]].patch, At(nodes[unknown[k]])});
      found.assign(size, {});
      sampler_.SampleAll(points, found);
      for (std::size_t k = 0; k < size; ++k) results[unknown[begin + k]] = std::move(found[k]);
      evaluations_ += size;
    }
    if (cache_ && !context_.Cancelled())
      for (const std::size_t i : unknown) cache_->Insert(nodes[i].patch, At(nodes[i]), results[i]);
    return results;
  }

  std::size_t evaluations() const { return evaluations_; }
  bool Knows(const Node& node) const { return cache_ && cache_->Find(node.patch, At(node)) != nullptr; }

 private:
  ReceiverPoint At(const Node& node) const {
    const IrradianceMesh::Triangle& t = mesh_.triangles[node.triangle];
    const auto corner = [&](int k) -> const Vec3& { return mesh_.positions[t.vertex[k % 3]]; };
    const int k = node.sample / 2;
    ReceiverPoint at;
    if (node.sample % 2 == 0) {
      at.position = corner(k);
    } else {
      // The order of ids makes the result equal, bit for bit, on both sides of the edge.
      const bool ascending = t.vertex[k] < t.vertex[(k + 1) % 3];
      at.position = 0.5 * (ascending ? corner(k) + corner(k + 1) : corner(k + 1) + corner(k));
    }
    at.normal = scene_.patches[node.patch].normal;
    at.approach = Inside(node.triangle) - at.position;
    if (node.sample % 2 == 0) {
      const CornerSheets& sheets = *sides_.sheets;
      const std::size_t sheet = sheets.Of(CornerSheets::Corner(node.triangle, static_cast<std::size_t>(k)));
      if (sheets.IsStraight(sheet)) at.approach = sheets.Into(sheet);
    }
    at.uncertainty = uncertainty_[node.patch];
    return at;
  }

  // The centroid of the triangle, or of the one beside it if it is flat.
  Vec3 Inside(std::size_t triangle) const {
    const auto& vertex = mesh_.triangles[sides_.flat ? sides_.flat->Beside(triangle) : triangle].vertex;
    return (mesh_.positions[vertex[0]] + mesh_.positions[vertex[1]] + mesh_.positions[vertex[2]]) / 3;
  }

  const IrradianceMesh& mesh_;
  const Sides sides_;
  const IrradianceSampler& sampler_;
  SampleCache* cache_;
  const ExecutionContext& context_;
  const Scene& scene_;
  std::vector<double> uncertainty_;  // per patch [m]
  std::size_t evaluations_ = 0;
};

}  // namespace

// Objects within the contact gap touch the node, even a node that is on no contact: near a foot where a
// shadow's edge starts, vertices lie within the gap.
double SampleUncertainty(const Scene& scene, const Patch& patch) {
  return Uncertainty(patch, ContactGap(scene));
}

namespace {

// The kinds of nodes: the remainder of (number of the sample in kSampleAt) / 2.
constexpr int kVertices = 0, kMidpoints = 1;

// The irradiance at the nodes of a mesh.
class NodeValues {
 public:
  NodeValues(const IrradianceMesh& mesh, const CornerSheets& sheets, bool midpoints, Sampling& sampling)
      : mesh_(mesh),
        sheets_(sheets),
        sampling_(sampling),
        nodes_(NumberNodes(mesh, midpoints)),
        values_(nodes_.first.size()),
        predicted_(nodes_.first.size(), 0) {}

  // Samples the nodes of one kind that are not predicted: each node for its first triangle, and one-sided
  // nodes for every other triangle as well, but only once for each straight sheet.
  void Sample(int kind, double done_before, double done_after) {
    std::vector<Slot> slots;
    std::vector<Node> at;
    for (Slot slot = 0; slot < predicted_.size(); ++slot)
      if (nodes_.first[slot].sample % 2 == kind && !predicted_[slot]) {
        slots.push_back(slot);
        at.push_back(nodes_.first[slot]);
      }
    constexpr double kFirstShare = 0.8;
    const double done_first = done_before + kFirstShare * (done_after - done_before);
    std::vector<PointIrradianceResult> sampled = sampling_.Evaluate(at, done_before, done_first);
    for (std::size_t i = 0; i < slots.size(); ++i) values_[slots[i]] = std::move(sampled[i]);
    asked_.insert(asked_.end(), slots.begin(), slots.end());
    sampled = sampling_.Evaluate(SplitOneSided(kind), done_first, done_after);
    for (std::size_t i = 0; i < sampled.size(); ++i) asked_.push_back(static_cast<Slot>(values_.size() + i));
    std::move(sampled.begin(), sampled.end(), std::back_inserter(values_));
  }

  // For each triangle, the numbers of its samples in the order in which they were evaluated. REQUIRES: all
  // have been sampled.
  std::vector<std::array<std::uint32_t, 6>> SampleNumbers() const {
    std::vector<std::uint32_t> number(values_.size());
    for (std::size_t i = 0; i < asked_.size(); ++i) number[asked_[i]] = static_cast<std::uint32_t>(i);
    std::vector<std::array<std::uint32_t, 6>> numbers(nodes_.of_triangle.size());
    for (std::size_t t = 0; t < numbers.size(); ++t)
      for (std::size_t k = 0; k < 6; ++k) numbers[t][k] = number[nodes_.of_triangle[t][k]];
    return numbers;
  }

  // Predicts midpoints where irradiance bends little (Interpolation::smooth), from the samples at vertices.
  void PredictMidpoints(double smooth) {
    std::vector<std::array<Rgb, 3>> corner(mesh_.triangles.size());
    Rgb mean = Rgb::Zero();
    for (std::size_t t = 0; t < corner.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        corner[t][static_cast<std::size_t>(k)] = Value(t, 2 * k);
        mean += Value(t, 2 * k) / static_cast<double>(3 * corner.size());
      }
    const MidpointPrediction prediction(mesh_, sheets_, corner);
    const std::vector<std::size_t> on_patch = TrianglesByPatch();
    std::vector<char> bends(predicted_.size(), 0);
    for (std::size_t t = 0; t < corner.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Slot slot = nodes_.of_triangle[t][2 * k + 1];
        const auto middle = prediction.At(t, k);
        const Rgb allowed = 0.5 * smooth * middle.value.max(kErrorFloor * mean);
        // On a contact the two sides have different values, and light changes fastest away from a contact.
        const bool from = Result(t, 2 * k).one_sided, to = Result(t, 2 * ((k + 1) % 3)).one_sided;
        const bool at_contact = from != to || (from && mesh_.triangles[t].discontinuity[k]);
        const bool known = sampling_.Knows(
            {mesh_.triangles[t].patch, static_cast<std::uint32_t>(t), static_cast<std::uint8_t>(2 * k + 1)});
        const bool few = on_patch[static_cast<std::size_t>(mesh_.triangles[t].patch)] < kFewTriangles;
        if (at_contact || known || few || (middle.bend.abs() > allowed).any()) bends[slot] = 1;
        // The mean of the predictions of both sides.
        const bool is_first = !predicted_[slot];
        Rgb& value = values_[slot].irradiance;
        value = is_first ? middle.value : Rgb(0.5 * (value + middle.value));
        predicted_[slot] = 1;
      }
    for (std::size_t slot = 0; slot < bends.size(); ++slot)
      if (bends[slot]) predicted_[slot] = 0;
  }

  bool IsPredicted(std::size_t t, int sample) const {
    const Slot slot = nodes_.of_triangle[t][static_cast<std::size_t>(sample)];
    return slot < predicted_.size() && predicted_[slot] != 0;
  }
  const Rgb& Value(std::size_t t, int sample) const {
    return Result(t, static_cast<std::size_t>(sample)).irradiance;
  }

 private:
  // Gives one-sided nodes a slot for each triangle or straight sheet, and returns the nodes of the new slots.
  std::vector<Node> SplitOneSided(int kind) {
    std::vector<Node> added;
    std::unordered_map<std::size_t, Slot> of_sheet;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int sample = kind; sample < 6; sample += 2) {
        Slot& slot = nodes_.of_triangle[t][sample];
        if (!values_[slot].one_sided) continue;
        const std::size_t sheet = sheets_.Of(CornerSheets::Corner(t, static_cast<std::size_t>(sample / 2)));
        const bool shares = kind == kVertices && sheets_.IsStraight(sheet);
        const bool is_first = nodes_.first[slot].triangle == t;
        const auto next = static_cast<Slot>(values_.size() + added.size());
        const Slot own = is_first ? slot : next;
        const auto [place, is_new] =
            shares ? of_sheet.try_emplace(sheet, own) : std::pair(of_sheet.end(), true);
        slot = is_new ? own : place->second;
        if (is_new && !is_first)
          added.push_back(
              {mesh_.triangles[t].patch, static_cast<std::uint32_t>(t), static_cast<std::uint8_t>(sample)});
      }
    return added;
  }

  // Fewer triangles on a patch may miss the whole light of a lamp.
  static constexpr std::size_t kFewTriangles = 32;

  std::vector<std::size_t> TrianglesByPatch() const {
    std::vector<std::size_t> count;
    for (const IrradianceMesh::Triangle& t : mesh_.triangles) {
      count.resize(std::max(count.size(), static_cast<std::size_t>(t.patch) + 1));
      ++count[static_cast<std::size_t>(t.patch)];
    }
    return count;
  }
  const PointIrradianceResult& Result(std::size_t t, std::size_t sample) const {
    return values_[nodes_.of_triangle[t][sample]];
  }

  const IrradianceMesh& mesh_;
  const CornerSheets& sheets_;
  Sampling& sampling_;
  Nodes nodes_;
  std::vector<PointIrradianceResult> values_;  // by slot
  std::vector<char> predicted_;                // by slot of the first triangles
  std::vector<Slot> asked_;                    // the slots of all samples, in the order of their evaluation
};

}  // namespace

BuiltMesh BuildIrradianceMesh(const Scene& scene, std::span<const PatchTriangulation> patches,
                              const Interpolation& how, const IrradianceSampler& sampler,
                              const ExecutionContext& context, SampleCache* cache) {
  PENUMBRA_CHECK(how.order != InterpolantOrder::kConstant);
  BuiltMesh built;
  built.mesh = JoinPatches(patches);
  IrradianceMesh& mesh = built.mesh;
  const bool quadratic = how.order == InterpolantOrder::kQuadratic;
  const FlatTriangles flat(mesh, OnePlace(scene));
  const CornerSheets sheets(mesh, &flat);
  Sampling sampling(scene, mesh, {&flat, &sheets}, sampler, cache, context);
  NodeValues nodes(mesh, sheets, quadratic, sampling);
  constexpr double kVerticesShare = 0.4;
  nodes.Sample(kVertices, 0, quadratic ? kVerticesShare : 1);
  if (quadratic && how.smooth > 0) nodes.PredictMidpoints(how.smooth);
  if (quadratic) nodes.Sample(kMidpoints, kVerticesShare, 1);
  built.point_evaluations = sampling.evaluations();
  if (quadratic && how.smooth <= 0 && !cache && !context.Cancelled())
    built.sample_numbers = nodes.SampleNumbers();

  mesh.irradiance.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto value = [&](int sample) { return nodes.Value(t, sample); };
    if (quadratic && (nodes.IsPredicted(t, 1) || nodes.IsPredicted(t, 3) || nodes.IsPredicted(t, 5)))
      built.predicted.push_back(static_cast<std::uint32_t>(t));
    mesh.irradiance[t] =
        quadratic
            ? QuadraticInterpolant::Quadratic({value(0), value(1), value(2), value(3), value(4), value(5)})
            : QuadraticInterpolant::Linear({value(0), value(2), value(4)});
  }
  return built;
}

std::size_t SampleMidpoints(const Scene& scene, const IrradianceMesh& mesh,
                            std::span<const std::uint32_t> triangles, const IrradianceSampler& sampler,
                            const ExecutionContext& context, SampleCache& cache) {
  Sampling sampling(scene, mesh, {}, sampler, &cache, context);
  std::vector<Node> nodes;
  for (const std::uint32_t t : triangles)
    for (std::uint8_t sample = 1; sample < 6; sample += 2)
      nodes.push_back({mesh.triangles[t].patch, t, sample});
  sampling.Evaluate(nodes, 0, 1);
  return sampling.evaluations();
}

IrradianceMesh BuildConstantMesh(std::span<const PatchTriangulation> patches,
                                 std::span<const Rgb> element_irradiance) {
  IrradianceMesh mesh = JoinPatches(patches);
  for (const PatchTriangulation& patch : patches)
    for (std::size_t leaf = 0; leaf < patch.leaves.size(); ++leaf) {
      const Rgb& irradiance = element_irradiance[static_cast<std::size_t>(patch.leaves[leaf])];
      for (std::uint32_t t = patch.first_triangle[leaf]; t < patch.first_triangle[leaf + 1]; ++t)
        mesh.irradiance.push_back(QuadraticInterpolant::Constant(irradiance));
    }
  return mesh;
}

}  // namespace penumbra
