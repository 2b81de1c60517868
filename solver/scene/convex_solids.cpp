#include "solver/scene/convex_solids.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace penumbra {
namespace {

// A corner is on a plane if it is this near, relative to the coordinates: roundings of turned boxes.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

struct LessByCoordinates {
  bool operator()(const Vec3& a, const Vec3& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }
};

using CornerId = std::int32_t;
using DirectedEdge = std::pair<CornerId, CornerId>;

class SolidFinder {
 public:
  explicit SolidFinder(Scene& scene) : scene_(scene) {}

  void Find() {
    scene_.solids.clear();
    scene_.solid_of.assign(scene_.patches.size(), kNoSolid);
    NumberCorners();
    JoinAtConvexEdges();
    std::map<PatchId, std::vector<PatchId>> groups;
    for (PatchId p = 0; p < Size(); ++p) groups[Root(p)].push_back(p);
    for (const auto& [root, patches] : groups) {
      if (patches.size() < 2 || patches.size() > kMostSides) continue;
      std::optional<ConvexSolid> solid = Close(patches);
      if (!solid) continue;
      for (const PatchId p : patches) scene_.solid_of[p] = static_cast<SolidId>(scene_.solids.size());
      scene_.solids.push_back(std::move(*solid));
    }
  }

 private:
  PatchId Size() const { return static_cast<PatchId>(scene_.patches.size()); }

  PatchId Root(PatchId p) {
    while (parent_[p] != p) p = parent_[p] = parent_[parent_[p]];
    return p;
  }

  void NumberCorners() {
    std::map<Vec3, CornerId, LessByCoordinates> numbers;
    for (PatchId p = 0; p < Size(); ++p) {
      std::vector<CornerId>& loop = loops_.emplace_back();
      for (const Vec3& v : scene_.patches[p].Vertices()) {
        const auto [place, is_new] = numbers.try_emplace(v, static_cast<CornerId>(positions_.size()));
        if (is_new) positions_.push_back(v);
        loop.push_back(place->second);
      }
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const auto [place, is_new] = patch_at_.try_emplace({loop[i], loop[(i + 1) % loop.size()]}, p);
        if (!is_new) place->second = kNoPatch;  // two patches along the same way: no one knows which is meant
      }
    }
  }

  void JoinAtConvexEdges() {
    parent_.resize(scene_.patches.size());
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const auto& [edge, p] : patch_at_) {
      const auto other = patch_at_.find({edge.second, edge.first});
      if (p == kNoPatch || other == patch_at_.end() || other->second == kNoPatch) continue;
      const PatchId q = other->second;
      if (Behind(loops_[q], scene_.patches[p]) && Behind(loops_[p], scene_.patches[q]))
        parent_[Root(p)] = Root(q);
    }
  }

  bool Behind(std::span<const CornerId> corners, const Vec3& normal, const Vec3& on, double extent) const {
    return std::all_of(corners.begin(), corners.end(), [&](CornerId c) {
      return normal.dot(positions_[c] - on) <= kRounding * std::max(extent, MaxAbs(positions_[c]));
    });
  }
  bool Behind(std::span<const CornerId> corners, const Patch& patch) const {
    return Behind(corners, patch.normal, patch.vertex[0], patch.extent);
  }

  bool IsFlat(std::span<const CornerId> corners, const Patch& patch) const {
    return Behind(corners, -patch.normal, patch.vertex[0], patch.extent);
  }

  // The solid that the patches and planar missing sides enclose; none if they do not.
  std::optional<ConvexSolid> Close(const std::vector<PatchId>& patches) const {
    std::vector<CornerId> corners;
    for (const PatchId p : patches) corners.insert(corners.end(), loops_[p].begin(), loops_[p].end());
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() > kMostCorners) return std::nullopt;

    ConvexSolid solid;
    std::map<CornerId, CornerId>
        open;  // what a missing side goes along: the reverse of edges without another
    std::map<DirectedEdge, PatchId> along;
    for (const PatchId p : patches) {
      const Patch& patch = scene_.patches[p];
      if (!Behind(corners, patch)) return std::nullopt;
      solid.extent = std::max(solid.extent, patch.extent);
      solid.sides.push_back({p, patch.normal, loops_[p], {}});
      for (std::size_t i = 0; i < loops_[p].size(); ++i)
        if (!along.try_emplace({loops_[p][i], loops_[p][(i + 1) % loops_[p].size()]}, p).second)
          return std::nullopt;
    }
    for (const auto& [edge, p] : along)
      if (!along.contains({edge.second, edge.first}) && !open.try_emplace(edge.second, edge.first).second)
        return std::nullopt;
    while (!open.empty()) {
      std::optional<ConvexSolid::Side> side = MissingSide(open, corners, solid.extent);
      if (!side || solid.sides.size() == kMostSides) return std::nullopt;
      solid.sides.push_back(std::move(*side));
    }
    // In one plane every side has all corners behind it, whatever the outline: only a front and its back will
    // do.
    if (solid.sides.size() > 2 && IsFlat(corners, scene_.patches[patches[0]])) return std::nullopt;
    Renumber(corners, solid);
    return solid;
  }

  // Takes one loop of open edges; none if no side with all corners behind it fits.
  std::optional<ConvexSolid::Side> MissingSide(std::map<CornerId, CornerId>& open,
                                               std::span<const CornerId> corners, double extent) const {
    ConvexSolid::Side side;
    Polygon3 polygon;
    for (auto at = open.begin(); at != open.end(); at = open.find(side.corner.back())) {
      side.corner.push_back(at->second);
      polygon.push_back(positions_[at->second]);
      open.erase(at);
    }
    if (polygon.size() < 3) return std::nullopt;
    const Vec3 area = VectorArea(polygon);
    if (area.isZero(0)) return std::nullopt;
    side.normal = area.normalized();
    const bool planar = std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& v) {
      return std::abs(side.normal.dot(v - polygon[0])) <= kRounding * extent;
    });
    if (!planar || !Behind(corners, side.normal, polygon[0], extent)) return std::nullopt;
    return side;
  }

  // Numbers the solid's corners and edges among its own.
  void Renumber(std::span<const CornerId> corners, ConvexSolid& solid) const {
    for (const CornerId c : corners) solid.corners.push_back(positions_[c]);
    std::map<DirectedEdge, std::int32_t> edges;
    for (ConvexSolid::Side& side : solid.sides) {
      for (CornerId& c : side.corner)
        c = static_cast<std::int32_t>(std::lower_bound(corners.begin(), corners.end(), c) - corners.begin());
      for (std::size_t i = 0; i < side.corner.size(); ++i) {
        const auto [low, high] = std::minmax(side.corner[i], side.corner[(i + 1) % side.corner.size()]);
        side.edge.push_back(
            edges.try_emplace({low, high}, static_cast<std::int32_t>(edges.size())).first->second);
      }
    }
  }

  Scene& scene_;
  Polygon3 positions_;                        // of all corners
  std::vector<std::vector<CornerId>> loops_;  // per patch
  std::map<DirectedEdge, PatchId> patch_at_;  // kNoPatch: several
  std::vector<PatchId> parent_;
};

}  // namespace

void FindConvexSolids(Scene& scene) { SolidFinder(scene).Find(); }

}  // namespace penumbra
