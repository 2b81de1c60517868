// solver/visibility/pair/patch_hierarchy.h
//
// A bounding volume hierarchy over patches, to find the patches in a convex region, such as a tube, that no
// screen hides.

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
  // A hierarchy over the given patches of the scene. The constructor copies the bounding boxes of the
  // patches.
  PatchHierarchy(const Scene& scene, std::vector<PatchId> patches);

  std::size_t size() const { return order_.size(); }

  // Replaces `found` by the patches, in ascending order, whose bounding boxes intersect the region and do not
  // lie completely in the shadow of one of the screens. The result is conservative: because of rounding, it
  // may include patches just outside the region, but it omits none.
  void Find(const ConvexRegion& region, std::span<const Screen> screens, std::vector<PatchId>& found) const;

 private:
  // The nodes are in depth-first order, parents before children. A leaf has one patch.
  struct Node {
    Vec3 centre, half;                  // of the bounding box [m]
    std::int32_t skip = 1;              // number of nodes in this subtree, including this node
    std::int32_t first = 0, count = 0;  // the subtree's patches, in order_
  };
  bool Hidden(const Node& node, std::span<const Screen> screens) const;
  void Build(const Scene& scene, std::size_t first, std::size_t last);

  std::vector<PatchId> order_;
  std::vector<Node> nodes_;
  double margin_ = 0;  // bound of the rounding of boxes and heights [m]
};

}  // namespace penumbra
