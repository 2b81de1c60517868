#include "mesh/refinement/source_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "mesh/refinement/covered_light.h"
#include "solver/base/parallel.h"
#include "solver/transport/points/leaf_cells.h"
#include "solver/transport/points/nearest_patches.h"
#include "solver/transport/sources/error_floors.h"
#include "solver/transport/sources/leaf_fragments.h"

namespace penumbra {
namespace {

// A cell is divided only while its area is above this times that of the largest triangle of the mesh that it
// meets, and at most this many times in succession.
constexpr double kLeastOfTriangle = 1.0 / 64;
constexpr int kMostLevels = 12;
// For Change(): the fraction of the area that may change by more.
constexpr double kChangedArea = 0.01;

// Divides the leaves of one patch into cells.
class CellDivider {
 public:
  CellDivider(const RadiositySolution& solution, const Rgb& mean_radiosity, const SourceCellOptions& options,
              std::vector<SourceCell>& cells)
      : solution_(solution), mean_radiosity_(mean_radiosity), options_(options), cells_(cells) {}

  // `light` is the mesh on the leaf, in the plane of `frame`; `pieces` are the pieces into which contacts cut
  // the leaf.
  void AddLeaf(ElementId leaf, const CoveredLight& light, const Frame& frame,
               std::span<const Fragment> pieces, std::span<const PatchPair> seen) {
    const Element& element = solution_.forest[leaf];
    const Scene& scene = solution_.forest.scene();
    leaf_ = leaf;
    frame_ = frame;
    normal_ = scene.patches[static_cast<std::size_t>(element.patch)].normal;
    reflectance_ = scene.MaterialOf(element.patch).reflectance;
    near_.emplace(scene, element.Vertices(), seen);
    const std::size_t before = FirstOf(leaf), end = before < options_.before.size() ? EndOf(before) : before;
    if (pieces.empty()) {
      Add(SourcePolygon(element.Vertices()), light, -1, Earlier{before, end}, 0);
      return;
    }
    const std::size_t root = Append(SourcePolygon(element.Vertices()), light, -1);
    Earlier earlier{before + 1, end};
    for (const Fragment& piece : pieces)
      for (const SourcePolygon& part : Fan(piece.polygon)) {
        Add(part, Within(part, light), static_cast<std::int32_t>(root), earlier, 0);
        earlier.Next(options_.before);
      }
    Close(root);
  }

 private:
  // The cells of an earlier light from a cell on, up to the end of the cell's siblings.
  struct Earlier {
    std::size_t at, end;
    bool None() const { return at >= end; }
    void Next(std::span<const SourceCell> cells) {
      if (!None()) at += static_cast<std::size_t>(cells[at].skip);
    }
  };

  std::size_t FirstOf(ElementId leaf) const {
    const auto found = std::partition_point(options_.before.begin(), options_.before.end(),
                                            [&](const SourceCell& cell) { return cell.leaf < leaf; });
    const auto at = static_cast<std::size_t>(found - options_.before.begin());
    return at < options_.before.size() && options_.before[at].leaf == leaf ? at : options_.before.size();
  }
  std::size_t EndOf(std::size_t cell) const {
    return cell + static_cast<std::size_t>(options_.before[cell].skip);
  }

  CoveredLight Within(const SourcePolygon& polygon, const CoveredLight& light) const {
    std::array<Vec2, 4> corner;
    for (std::size_t k = 0; k < polygon.Vertices().size(); ++k) corner[k] = frame_.ToPlane(polygon.vertex[k]);
    return light.Within({corner.data(), polygon.Vertices().size()});
  }

  // Adds a cell and the cells below it. `earlier` is at the cell of the same place, if there was one.
  void Add(const SourcePolygon& polygon, const CoveredLight& light, std::int32_t parent,
           const Earlier& earlier, int level) {
    const std::size_t at = Append(polygon, light, parent);
    const bool was_divided = !earlier.None() && options_.before[earlier.at].skip > 1;
    const bool may_divide =
        level < kMostLevels && cells_[at].area > kLeastOfTriangle * light.LargestTriangle();
    if (was_divided || (cells_[at].score > options_.finest && may_divide)) {
      Earlier below{0, 0};
      if (was_divided) below = {earlier.at + 1, EndOf(earlier.at)};
      for (const SourcePolygon& quarter : Quarters(polygon)) {
        Add(quarter, Within(quarter, light), static_cast<std::int32_t>(at), below, level + 1);
        below.Next(options_.before);
      }
    }
    Close(at);
  }

  std::size_t Append(const SourcePolygon& polygon, const CoveredLight& light, std::int32_t parent) {
    SourceCell cell;
    cell.leaf = leaf_;
    cell.parent = parent;
    cell.polygon = polygon;
    cell.area = VectorArea(polygon.Vertices()).norm();
    // A leaf that is too narrow for its points has triangles of zero area, or none.
    const Rgb mean = light.area() > 0 ? light.Mean() : solution_.irradiance[static_cast<std::size_t>(leaf_)];
    cell.irradiance = mean.max(0.0);
    const Rgb deviation = light.Deviation(mean);
    for (int c = 0; c < 3; ++c) {
      const double around = std::max(reflectance_[c] * cell.irradiance[c], kCellFloor * mean_radiosity_[c]);
      if (around > 0) cell.score = std::max(cell.score, reflectance_[c] * deviation[c] / around);
    }
    cell.score *= LargestFactor(polygon.Vertices());
    cells_.push_back(cell);
    return cells_.size() - 1;
  }

  // Ends the subtree of a cell. Its irradiance becomes the mean of its children's.
  void Close(std::size_t at) {
    cells_[at].skip = static_cast<std::int32_t>(cells_.size() - at);
    if (cells_[at].skip == 1) return;
    Rgb sum = Rgb::Zero();
    double area = 0;
    for (std::size_t i = at + 1; i < cells_.size(); i += static_cast<std::size_t>(cells_[i].skip)) {
      sum += cells_[i].area * cells_[i].irradiance;
      area += cells_[i].area;
    }
    if (area > 0) cells_[at].irradiance = sum / area;
  }

  // The approximate largest form factor of the polygon to a point of another patch, including light that
  // returns repeatedly from there. The deviations of the polygon's light average out, so that their effect
  // falls with one more power of the distance.
  double LargestFactor(std::span<const Vec3> polygon) const {
    const Scene& scene = solution_.forest.scene();
    const Vec3 centre = Centroid(polygon);
    const double size = Diameter(polygon);
    double largest = 0;
    for (const PatchId id : near_->patches()) {
      const Patch& patch = scene.patches[static_cast<std::size_t>(id)];
      const double gap = 1 + std::max(0.0, near_->DistanceTo(id, centre) / size - 0.5);
      // For half-planes that meet at this angle, next to their common edge.
      const double wedge = 0.5 * (1 - normal_.dot(patch.normal));
      const double factor = wedge / (gap * gap * gap);
      const double returned = (reflectance_ * scene.MaterialOf(id).reflectance).maxCoeff() * factor * factor;
      largest = std::max(largest, factor / (1 - returned));
    }
    return largest;
  }

  const RadiositySolution& solution_;
  const Rgb mean_radiosity_;
  const SourceCellOptions& options_;
  std::vector<SourceCell>& cells_;
  // For the present leaf.
  ElementId leaf_ = kNoElement;
  Frame frame_;
  Vec3 normal_ = Vec3::Zero();
  Rgb reflectance_ = Rgb::Zero();
  std::optional<NearestPatches> near_;
};

}  // namespace

SourceCells::SourceCells(const RadiositySolution& solution, const MeshWithLeaves& shown,
                         const PointIrradiance& exact, const SourceCellOptions& options,
                         const ExecutionContext& context)
    : solution_(solution) {
  const std::span<const PatchTriangulation> patches = shown.patches;
  const Scene& scene = solution.forest.scene();
  const Rgb mean_radiosity = MeanReflected(solution);
  std::vector<std::uint32_t> first(patches.size() + 1, 0);
  for (std::size_t p = 0; p < patches.size(); ++p)
    first[p + 1] = first[p] + static_cast<std::uint32_t>(patches[p].triangles.size());
  const auto in_solution = [&](ElementId id) {
    while (static_cast<std::size_t>(id) >= solution.forest.size() || !solution.forest[id].IsLeaf())
      id = shown.forest[id].parent;
    return id;
  };
  const std::vector<Fragment> pieces = CutLeavesAtContacts(solution.forest, context);
  std::vector<std::vector<SourceCell>> by_patch(patches.size());
  ParallelFor(patches.size(), 1, [&](std::size_t p) {
    const PatchTriangulation& patch = patches[p];
    if (context.Cancelled()) return;
    if ((scene.MaterialOf(patch.patch).reflectance == 0).all()) return;
    const Frame frame = PolygonFrame(scene.patches[p].Vertices());
    CellDivider divider(solution, mean_radiosity, options, by_patch[p]);
    for (std::size_t begin = 0, end = 0; begin < patch.leaves.size() && !context.Cancelled(); begin = end) {
      const ElementId leaf = in_solution(patch.leaves[begin]);
      while (end < patch.leaves.size() && in_solution(patch.leaves[end]) == leaf) ++end;
      const CoveredLight light(shown.mesh, first[p] + patch.first_triangle[begin],
                               first[p] + patch.first_triangle[end], frame);
      divider.AddLeaf(leaf, light, frame, FragmentsOf(pieces, leaf), exact.SeenFrom(leaf));
    }
  });
  Collect(by_patch);
}

// Joins the cells of all patches in one list, in ascending order of leaves.
void SourceCells::Collect(const std::vector<std::vector<SourceCell>>& by_patch) {
  struct Range {
    ElementId leaf;
    std::size_t patch, at;
  };
  std::vector<Range> ranges;
  for (std::size_t p = 0; p < by_patch.size(); ++p)
    for (std::size_t i = 0; i < by_patch[p].size(); i += static_cast<std::size_t>(by_patch[p][i].skip))
      ranges.push_back({by_patch[p][i].leaf, p, i});
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.leaf < b.leaf; });
  for (const Range& range : ranges) {
    const auto shift = static_cast<std::int32_t>(cells_.size()) - static_cast<std::int32_t>(range.at);
    const auto from = by_patch[range.patch].begin() + static_cast<std::ptrdiff_t>(range.at);
    for (auto cell = from; cell != from + from->skip; ++cell) {
      cells_.push_back(*cell);
      if (cell->parent >= 0) cells_.back().parent += shift;
    }
  }
}

std::vector<Rgb> SourceCells::LeafIrradiance() const {
  std::vector<Rgb> irradiance = solution_.irradiance;
  for (std::size_t i = 0; i < cells_.size(); i += static_cast<std::size_t>(cells_[i].skip))
    irradiance[static_cast<std::size_t>(cells_[i].leaf)] = cells_[i].irradiance;
  return irradiance;
}

double SourceCells::Change() const {
  Rgb mean = Rgb::Zero();
  double area = 0;
  for (std::size_t i = 0; i < cells_.size(); i += static_cast<std::size_t>(cells_[i].skip)) {
    mean += cells_[i].area * cells_[i].irradiance;
    area += cells_[i].area;
  }
  std::vector<std::pair<double, double>> changes;  // each with its area
  for (std::size_t i = 0; i < cells_.size(); i += static_cast<std::size_t>(cells_[i].skip)) {
    const Rgb& was = solution_.irradiance[static_cast<std::size_t>(cells_[i].leaf)];
    const Rgb scale =
        cells_[i].irradiance.max(kErrorFloor / area * mean).max(std::numeric_limits<double>::min());
    changes.emplace_back(((cells_[i].irradiance - was).abs() / scale).maxCoeff(), cells_[i].area);
  }
  std::sort(changes.begin(), changes.end(), std::greater<>());
  double above = 0;
  for (const auto& [change, of] : changes)
    if ((above += of) >= kChangedArea * area) return change;
  return 0;
}

std::vector<Fragment> SourceCells::Fragments(bool whole_leaves) const {
  const Scene& scene = solution_.forest.scene();
  std::vector<Fragment> fragments;
  for (const SourceCell& cell : cells_) {
    if (cell.skip > 1 || (cell.parent < 0 && !whole_leaves)) continue;
    const Material& material = scene.MaterialOf(solution_.forest[cell.leaf].patch);
    Fragment fragment;
    fragment.leaf = cell.leaf;
    fragment.polygon.assign(cell.polygon.Vertices().begin(), cell.polygon.Vertices().end());
    fragment.area = cell.area;
    fragment.irradiance = cell.irradiance;
    fragment.radiosity = material.emittance + material.reflectance * cell.irradiance;
    fragments.push_back(std::move(fragment));
  }
  return fragments;
}

}  // namespace penumbra
