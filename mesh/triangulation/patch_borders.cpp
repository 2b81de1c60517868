#include "mesh/triangulation/patch_borders.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "mesh/discontinuities/leaf_margins.h"
#include "solver/base/check.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

struct StretchKey {
  LatticePoint a, b;
  bool operator==(const StretchKey&) const = default;
};
struct StretchKeyHash {
  std::size_t operator()(const StretchKey& k) const {
    return LatticePointHash()(k.a) * 31 + LatticePointHash()(k.b);
  }
};

}  // namespace

// Computes the borders of one patch.
class PatchBorders::Builder {
 public:
  Builder(const ElementForest& forest, const Patch& patch, const PatchDSets& dsets, PatchBorders& borders)
      : forest_(forest), patch_(patch), dsets_(dsets), to_(borders) {}

  void Build() {
    for (const ElementId leaf : dsets_.leaves)
      for (const LatticePoint& p : forest_[leaf].Corners()) AddCorner(p);
    for (const ElementId leaf : dsets_.leaves) AddStretches(forest_[leaf]);
    for (std::size_t leaf = 0; leaf < dsets_.leaves.size(); ++leaf)
      for (const std::int32_t line : dsets_.leaf_lines[leaf])
        for (const StretchUse& use : to_.uses_[leaf]) Cross(to_.stretches_[use.stretch], line);
    for (Stretch& stretch : to_.stretches_) PlaceCrossings(stretch);
  }

 private:
  void AddCorner(const LatticePoint& p) {
    const auto [place, added] = corner_.try_emplace(p, static_cast<VertexId>(to_.positions.size()));
    if (!added) return;
    to_.positions.push_back(LatticePosition(patch_, p));
    to_.in_plane.push_back(to_.frame.ToPlane(to_.positions.back()));
  }

  void AddStretches(const Element& leaf) {
    std::vector<StretchUse>& uses = to_.uses_.emplace_back();
    for (std::int32_t k = 0; k < leaf.size; ++k) {
      const LatticePoint a = leaf.corner[k], b = leaf.corner[(k + 1) % leaf.size];
      const bool halves = (a.x + b.x) % 2 == 0 && (a.y + b.y) % 2 == 0;
      if (halves && corner_.contains(Midpoint(a, b))) {
        uses.push_back(Use(a, Midpoint(a, b)));
        uses.push_back(Use(Midpoint(a, b), b));
      } else {
        uses.push_back(Use(a, b));
      }
    }
  }

  StretchUse Use(const LatticePoint& from, const LatticePoint& to) {
    const bool reversed = to < from;
    const StretchKey key = reversed ? StretchKey{to, from} : StretchKey{from, to};
    const auto [place, added] = stretch_.try_emplace(key, static_cast<std::uint32_t>(to_.stretches_.size()));
    if (added) to_.stretches_.push_back({corner_.at(key.a), corner_.at(key.b), {}, {}, 0});
    ++to_.stretches_[place->second].uses;
    return {place->second, reversed};
  }

  // Records where the line crosses the stretch, or where discontinuities that run along the stretch end. A
  // corner within the snap distance of the line lies on the line.
  void Cross(Stretch& stretch, std::int32_t number) const {
    const DiscontinuityLine& line = dsets_.lines[number];
    const Vec2 &a = to_.in_plane[stretch.a], &b = to_.in_plane[stretch.b];
    const double da = line.Distance(a), db = line.Distance(b);
    const bool a_on = std::abs(da) <= to_.snap, b_on = std::abs(db) <= to_.snap;
    if (a_on && b_on) NoteEnds(stretch, number);
    if (a_on || b_on || (da > 0) == (db > 0)) return;
    const double fraction = da / (da - db);
    const Vec2 at = a + fraction * (b - a);
    if (Covers(line.cover, line.Along(at), kLeafReach * to_.snap))
      stretch.crossings.push_back({fraction, number});
  }

  // For a stretch on the line: each end of a discontinuity within the stretch needs a vertex, because the
  // marked edge would be too long otherwise.
  void NoteEnds(Stretch& stretch, std::int32_t number) const {
    const DiscontinuityLine& line = dsets_.lines[number];
    const double a = line.Along(to_.in_plane[stretch.a]), b = line.Along(to_.in_plane[stretch.b]);
    for (const auto* intervals : {&line.cover, &line.contact})
      for (const LineInterval& i : *intervals)
        for (const double end : {i.t0, i.t1})
          if (end > std::min(a, b) + to_.snap && end < std::max(a, b) - to_.snap)
            stretch.crossings.push_back({(end - a) / (b - a), number});
  }

  // Crossings within the snap distance of each other become one vertex.
  void PlaceCrossings(Stretch& stretch) {
    std::sort(stretch.crossings.begin(), stretch.crossings.end());
    const double length = (to_.in_plane[stretch.b] - to_.in_plane[stretch.a]).norm();
    double last = -1;
    for (const auto& [fraction, line] : stretch.crossings) {
      if (last >= 0 && (fraction - last) * length <= to_.snap) continue;
      last = fraction;
      stretch.inner.push_back(to_.AddBetween(stretch, fraction));
    }
  }

  const ElementForest& forest_;
  const Patch& patch_;
  const PatchDSets& dsets_;
  PatchBorders& to_;
  std::unordered_map<LatticePoint, VertexId, LatticePointHash> corner_;
  std::unordered_map<StretchKey, std::uint32_t, StretchKeyHash> stretch_;
};

PatchBorders::PatchBorders(const ElementForest& forest, PatchId patch, const PatchDSets& dsets)
    : frame(PolygonFrame(forest.scene().patches[patch].Vertices())),
      snap(SnapDistance(forest.scene().patches[patch])) {
  PENUMBRA_CHECK(dsets.leaf_lines.size() == dsets.leaves.size());
  Builder(forest, forest.scene().patches[patch], dsets, *this).Build();
}

void PatchBorders::Around(std::size_t leaf, std::vector<VertexId>& loop) const {
  loop.clear();
  for (const StretchUse& use : uses_[leaf]) {
    const Stretch& s = stretches_[use.stretch];
    loop.push_back(use.reversed ? s.b : s.a);
    if (use.reversed) {
      loop.insert(loop.end(), s.inner.rbegin(), s.inner.rend());
    } else {
      loop.insert(loop.end(), s.inner.begin(), s.inner.end());
    }
  }
}

std::vector<Vec3> PatchBorders::OutlineVertices() const {
  std::vector<Vec3> vertices;
  for (const Stretch& stretch : stretches_) {
    if (stretch.uses != 1) continue;
    // Each corner of the outline is an end of two stretches. The list contains such a corner twice, without
    // harm.
    vertices.push_back(positions[stretch.a]);
    vertices.push_back(positions[stretch.b]);
    for (const VertexId v : stretch.inner) vertices.push_back(positions[v]);
  }
  return vertices;
}

void PatchBorders::Weld(std::span<const Vec3> points) {
  for (Stretch& stretch : stretches_) {
    if (stretch.uses != 1) continue;
    const Vec3 low = positions[stretch.a].cwiseMin(positions[stretch.b]).array() - snap;
    const Vec3 high = positions[stretch.a].cwiseMax(positions[stretch.b]).array() + snap;
    for (const Vec3& p : points)
      if ((p.array() >= low.array()).all() && (p.array() <= high.array()).all()) WeldTo(stretch, p);
  }
}

void PatchBorders::WeldTo(Stretch& stretch, const Vec3& point) {
  const Vec2 p = frame.ToPlane(point), a = in_plane[stretch.a], b = in_plane[stretch.b];
  const double length = (b - a).norm();
  if ((frame.FromPlane(p) - point).norm() > snap || std::abs(Cross2(b - a, p - a)) > snap * length) return;
  // A point within the snap distance of a vertex is that vertex.
  const auto is_near = [&](VertexId v) { return (in_plane[v] - p).norm() <= snap; };
  for (const VertexId end : {stretch.a, stretch.b})
    if (is_near(end)) {
      positions[end] = point;
      return;
    }
  const double fraction = (b - a).dot(p - a) / (length * length);
  if (!(fraction > 0 && fraction < 1)) return;
  auto place = stretch.inner.begin();
  for (; place != stretch.inner.end(); ++place) {
    if (is_near(*place)) {
      positions[*place] = point;
      return;
    }
    if ((b - a).dot(in_plane[*place] - a) > fraction * length * length) break;
  }
  const auto index = place - stretch.inner.begin();
  const VertexId added = AddBetween(stretch, fraction);
  positions[added] = point;
  stretch.inner.insert(stretch.inner.begin() + index, added);
}

PatchBorders::VertexId PatchBorders::AddBetween(const Stretch& stretch, double fraction) {
  // Copies, because the vectors grow.
  const Vec3 a = positions[stretch.a], b = positions[stretch.b];
  const Vec2 a2 = in_plane[stretch.a], b2 = in_plane[stretch.b];
  positions.push_back((1 - fraction) * a + fraction * b);
  in_plane.push_back((1 - fraction) * a2 + fraction * b2);
  return static_cast<VertexId>(positions.size() - 1);
}

}  // namespace penumbra
