#include "mesh/discontinuities/contact_corners.h"

#include <algorithm>

#include "solver/geometry/polygon.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

// Divides a patch's leaves towards the ends of contacts, one end after another.
class CornerDivider {
 public:
  CornerDivider(PatchId patch, int divisions, double min_area, ElementForest& forest)
      : normal_(forest.scene().patches[static_cast<std::size_t>(patch)].normal),
        snap_(SnapDistance(forest.scene().patches[static_cast<std::size_t>(patch)])),
        divisions_(divisions),
        min_area_(min_area),
        first_new_(static_cast<ElementId>(forest.size())),
        forest_(forest) {}

  // `deepest` is the level at which the division ends, known only below an element that was a leaf.
  void Divide(const Vec3& end, ElementId id, int deepest = 0) {
    if (!ConvexContains(forest_[id].Vertices(), normal_, end, snap_)) return;
    const bool is_leaf = forest_[id].IsLeaf();
    const bool was_leaf = id < first_new_ && (is_leaf || forest_[id].first_child >= first_new_);
    if (was_leaf) deepest = forest_[id].level + divisions_;
    if (is_leaf) {
      constexpr int kChildren = 4;
      const Element& leaf = forest_[id];
      if (leaf.level >= std::min(deepest, kMaxLevel) || leaf.area < kChildren * min_area_) return;
      forest_.Subdivide(id);
    }
    const ElementId child = forest_[id].first_child;
    for (ElementId c = child; c < child + 4; ++c) Divide(end, c, deepest);
  }

 private:
  const Vec3 normal_;
  const double snap_;
  const int divisions_;
  const double min_area_;
  const ElementId first_new_;
  ElementForest& forest_;
};

}  // namespace

std::vector<Vec2> ContactEnds(const Patch& patch, std::span<const Discontinuity> found) {
  const double snap = SnapDistance(patch);
  std::vector<Vec2> ends;
  for (const Discontinuity& d : found) {
    if (d.kind != DiscontinuityKind::kContact) continue;
    for (const Vec2& end : d.end)
      if (std::ranges::none_of(ends, [&](const Vec2& e) { return (e - end).norm() <= snap; }))
        ends.push_back(end);
  }
  return ends;
}

void DivideTowards(std::span<const Vec2> ends, int divisions, double min_area, PatchId patch,
                   ElementForest& forest) {
  if (divisions == 0 || ends.empty()) return;
  const Frame frame = PolygonFrame(forest.scene().patches[static_cast<std::size_t>(patch)].Vertices());
  CornerDivider divider(patch, divisions, min_area, forest);
  for (const Vec2& end : ends) divider.Divide(frame.FromPlane(end), ElementForest::Root(patch));
  forest.Balance(patch);
}

}  // namespace penumbra
