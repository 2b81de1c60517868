#include "mesh/refinement/source_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/transport/points/leaf_cells.h"
#include "solver/transport/points/nearest_patches.h"
#include "solver/transport/sources/error_floors.h"

namespace penumbra {
namespace {

// The largest number of successive quarterings of a mesh triangle.
constexpr int kMostQuartered = 3;
// For Change(): the fraction of the area that may change by more.
constexpr double kChangedArea = 0.01;

using Triangle3 = std::array<Vec3, 3>;

// A triangle with the six samples of a quadratic, in the order of kSampleAt.
struct QuadraticPiece {
  Triangle3 corner;
  std::array<Rgb, 6> sample;

  // The midpoint rule is exact for quadratics.
  Rgb Mean() const { return (sample[1] + sample[3] + sample[5]) / 3; }
};

QuadraticPiece PieceOf(const IrradianceMesh& mesh, std::uint32_t triangle) {
  QuadraticPiece piece;
  for (std::size_t k = 0; k < 3; ++k) piece.corner[k] = mesh.positions[mesh.triangles[triangle].vertex[k]];
  for (std::size_t i = 0; i < 6; ++i)
    piece.sample[i] = mesh.irradiance[triangle].At(kSampleAt[i][0], kSampleAt[i][1]);
  return piece;
}

std::array<QuadraticPiece, 4> Quarters(const QuadraticPiece& piece) {
  const QuadraticInterpolant q = QuadraticInterpolant::Quadratic(piece.sample);
  using Place = std::array<double, 2>;
  const Place a = {0, 0}, b = {1, 0}, c = {0, 1}, ab = {0.5, 0}, bc = {0.5, 0.5}, ca = {0, 0.5};
  const std::array<std::array<Place, 3>, 4> places = {{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}};
  std::array<QuadraticPiece, 4> quarters;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Place &from = places[i][k], &to = places[i][(k + 1) % 3];
      quarters[i].corner[k] = piece.corner[0] + from[0] * (piece.corner[1] - piece.corner[0]) +
                              from[1] * (piece.corner[2] - piece.corner[0]);
      quarters[i].sample[2 * k] = q.At(from[0], from[1]);
      quarters[i].sample[2 * k + 1] = q.At(0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]));
    }
  return quarters;
}

// True if a contact edge lies between two of the triangles.
bool DividedByContacts(std::span<const PatchTriangulation::Triangle> triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const PatchTriangulation::Triangle& triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (triangle.contact[k]) edges.push_back(std::minmax(triangle.vertex[k], triangle.vertex[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) != edges.end();
}

// Divides the leaves of one patch into cells.
class CellDivider {
 public:
  CellDivider(const RadiositySolution& solution, const IrradianceMesh& mesh, const Rgb& mean_radiosity,
              double finest, std::vector<SourceCell>& cells)
      : solution_(solution), mesh_(mesh), mean_radiosity_(mean_radiosity), finest_(finest), cells_(cells) {}

  // `divided` is true if something stands on the leaf, so that each side has its own light.
  void AddLeaf(ElementId leaf, std::uint32_t first, std::uint32_t end, bool divided,
               std::span<const PatchPair> seen) {
    const Element& element = solution_.forest[leaf];
    const Scene& scene = solution_.forest.scene();
    normal_ = scene.patches[static_cast<std::size_t>(element.patch)].normal;
    reflectance_ = scene.MaterialOf(element.patch).reflectance;
    near_.emplace(scene, element.Vertices(), seen);
    std::vector<QuadraticPiece> pieces;
    Rgb mean = Rgb::Zero();
    double area = 0;
    for (std::uint32_t t = first; t < end; ++t) {
      pieces.push_back(PieceOf(mesh_, t));
      const double a = VectorArea(pieces.back().corner).norm();
      mean += a * pieces.back().Mean();
      area += a;
    }
    // A leaf that is too narrow for its points has triangles of zero area, or none.
    if (area > 0)
      mean /= area;
    else
      mean = solution_.irradiance[static_cast<std::size_t>(leaf)];
    Rgb deviation = Rgb::Zero();
    for (const QuadraticPiece& piece : pieces)
      for (const Rgb& sample : piece.sample) deviation = deviation.max((sample - mean).abs());
    const std::size_t at = Add(leaf, -1, element.Vertices(), element.area, mean, deviation);
    if (divided) cells_[at].score = std::numeric_limits<double>::infinity();
    if (cells_[at].score > finest_)
      for (const QuadraticPiece& piece : pieces) AddPiece(leaf, at, piece, 0);
    Close(at);
  }

 private:
  void AddPiece(ElementId leaf, std::size_t parent, const QuadraticPiece& piece, int quartered) {
    const Rgb mean = piece.Mean();
    Rgb deviation = Rgb::Zero();
    for (const Rgb& sample : piece.sample) deviation = deviation.max((sample - mean).abs());
    const std::size_t at = Add(leaf, static_cast<std::int32_t>(parent), piece.corner,
                               VectorArea(piece.corner).norm(), mean, deviation);
    if (cells_[at].score > finest_ && quartered < kMostQuartered)
      for (const QuadraticPiece& quarter : Quarters(piece)) AddPiece(leaf, at, quarter, quartered + 1);
    Close(at);
  }

  std::size_t Add(ElementId leaf, std::int32_t parent, std::span<const Vec3> polygon, double area,
                  const Rgb& mean, const Rgb& deviation) {
    SourceCell cell;
    cell.leaf = leaf;
    cell.parent = parent;
    cell.size = static_cast<std::int32_t>(polygon.size());
    std::copy(polygon.begin(), polygon.end(), cell.vertex.begin());
    cell.area = area;
    cell.irradiance = mean.max(0.0);
    for (int c = 0; c < 3; ++c) {
      const double around = std::max(reflectance_[c] * cell.irradiance[c], kCellFloor * mean_radiosity_[c]);
      if (around > 0) cell.score = std::max(cell.score, reflectance_[c] * deviation[c] / around);
    }
    cell.score *= ShareOfView(polygon);
    cells_.push_back(cell);
    return cells_.size() - 1;
  }

  void Close(std::size_t at) {
    cells_[at].skip = static_cast<std::int32_t>(cells_.size() - at);
    for (std::size_t i = at + 1; i < cells_.size(); ++i)
      cells_[at].score = std::max(cells_[at].score, cells_[i].score);
  }

  // The approximate largest form factor of the polygon to a point of another patch, including light that
  // returns repeatedly from there. The deviations of the polygon's light average out, so that their effect
  // falls with one more power of the distance.
  double ShareOfView(std::span<const Vec3> polygon) const {
    const Scene& scene = solution_.forest.scene();
    const Vec3 centre = Centroid(polygon);
    const double size = Diameter(polygon);
    double share = 0;
    for (const PatchId id : near_->patches()) {
      const Patch& patch = scene.patches[static_cast<std::size_t>(id)];
      const double gap = 1 + std::max(0.0, near_->DistanceTo(id, centre) / size - 0.5);
      // For half-planes that meet at this angle, next to their common edge.
      const double wedge = 0.5 * (1 - normal_.dot(patch.normal));
      const double factor = wedge / (gap * gap * gap);
      const double returned = (reflectance_ * scene.MaterialOf(id).reflectance).maxCoeff() * factor * factor;
      share = std::max(share, factor / (1 - returned));
    }
    return share;
  }

  const RadiositySolution& solution_;
  const IrradianceMesh& mesh_;
  const Rgb mean_radiosity_;
  const double finest_;
  std::vector<SourceCell>& cells_;
  // For the present leaf.
  Vec3 normal_ = Vec3::Zero();
  Rgb reflectance_ = Rgb::Zero();
  std::optional<NearestPatches> near_;
};

}  // namespace

SourceCells::SourceCells(const RadiositySolution& solution, const MeshWithLeaves& shown,
                         const PointIrradiance& exact, double finest, const ExecutionContext& context)
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
  std::vector<std::vector<SourceCell>> by_patch(patches.size());
  ParallelFor(patches.size(), 1, [&](std::size_t p) {
    const PatchTriangulation& patch = patches[p];
    if (context.Cancelled()) return;
    if ((scene.MaterialOf(patch.patch).reflectance == 0).all()) return;
    CellDivider divider(solution, shown.mesh, mean_radiosity, finest, by_patch[p]);
    for (std::size_t begin = 0, end = 0; begin < patch.leaves.size() && !context.Cancelled(); begin = end) {
      const ElementId leaf = in_solution(patch.leaves[begin]);
      while (end < patch.leaves.size() && in_solution(patch.leaves[end]) == leaf) ++end;
      const std::uint32_t from = patch.first_triangle[begin], to = patch.first_triangle[end];
      const bool divided = DividedByContacts(std::span(patch.triangles).subspan(from, to - from));
      divider.AddLeaf(leaf, first[p] + from, first[p] + to, divided, exact.SeenFrom(leaf));
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

std::vector<std::int32_t> SourceCells::Cut(double score) const {
  std::vector<std::int32_t> cut;
  for (std::size_t i = 0; i < cells_.size();) {
    const bool whole = cells_[i].score <= score || cells_[i].skip == 1;
    if (whole) cut.push_back(static_cast<std::int32_t>(i));
    i += whole ? static_cast<std::size_t>(cells_[i].skip) : 1;
  }
  return cut;
}

std::vector<Fragment> SourceCells::Fragments(std::span<const std::int32_t> cut, bool whole_leaves) const {
  const Scene& scene = solution_.forest.scene();
  std::vector<Fragment> fragments;
  for (const std::int32_t i : cut) {
    const SourceCell& cell = cells_[static_cast<std::size_t>(i)];
    if (cell.parent < 0 && !whole_leaves) continue;
    const Material& material = scene.MaterialOf(solution_.forest[cell.leaf].patch);
    Fragment fragment;
    fragment.leaf = cell.leaf;
    fragment.polygon.assign(cell.vertex.begin(), cell.vertex.begin() + cell.size);
    fragment.area = cell.area;
    fragment.irradiance = cell.irradiance;
    fragment.radiosity = material.emittance + material.reflectance * cell.irradiance;
    fragments.push_back(std::move(fragment));
  }
  return fragments;
}

}  // namespace penumbra
