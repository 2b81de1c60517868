// solver/visibility/pair/patch_hierarchy.h
//
// A bounding volume hierarchy over patches. A search finds the patches that intersect a convex region and are
// not hidden by large patches (screens).

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/pair/screens.h"

namespace penumbra {

class PatchHierarchy {
 public:
  PatchHierarchy() = default;
  // Makes a hierarchy over the given patches of the scene. The constructor copies the bounding boxes of the
  // patches.
  PatchHierarchy(const Scene& scene, std::vector<PatchId> patches);

  std::size_t size() const { return order_.size(); }

  // Sets `found` to the patches, in ascending order, whose bounding boxes intersect the region and do not lie
  // completely in the shadow of one screen (large patch). The search is conservative: because of rounding,
  // `found` may include patches just outside the region, but no patch inside the region is missing.
  void Find(const ConvexRegion& region, std::span<const Screen> screens, std::vector<PatchId>& found) const;

 private:
  // The nodes are in depth-first order, parents before children. A leaf of the hierarchy has one patch.
  struct Node {
    Vec3 centre, half;  // the centre and the half size of the tree node's bounding box [m]
    // The number of nodes in the subtree of this node, including the node itself.
    std::int32_t skip = 1;
    // The patches below this node are order_[first] to order_[first + count - 1].
    std::int32_t first = 0, count = 0;
  };
  bool Hidden(const Node& node, std::span<const Screen> screens) const;
  void Build(const Scene& scene, std::size_t first, std::size_t last);

  std::vector<PatchId> order_;
  std::vector<Node> nodes_;
  // An upper bound of the rounding errors of bounding boxes and of heights above planes [m].
  double margin_ = 0;
};

}  // namespace penumbra
