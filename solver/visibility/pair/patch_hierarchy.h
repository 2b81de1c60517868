// solver/visibility/pair/patch_hierarchy.h
//
// A bounding hierarchy over patches: which of them may matter to a point, without a look at all the others.

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
  // Over the given patches of the scene; their boxes are copied.
  PatchHierarchy(const Scene& scene, std::vector<PatchId> patches);

  std::size_t size() const { return order_.size(); }

  // Replaces `found` by the patches whose boxes reach into the region and do not lie in the shadow of one of
  // the screens as a whole, ascending. Roundings count for the patches: some that just miss the region may be
  // among them.
  void Find(const ConvexRegion& region, std::span<const Screen> screens, std::vector<PatchId>& found) const;

 private:
  // In depth-first order; children follow their parent. A leaf has one patch.
  struct Node {
    Vec3 centre, half;                  // of its box [m]
    std::int32_t skip = 1;              // nodes in this subtree, this one counted
    std::int32_t first = 0, count = 0;  // its patches, in order_
  };
  bool Hidden(const Node& node, std::span<const Screen> screens) const;
  void Build(const Scene& scene, std::size_t first, std::size_t last);

  std::vector<PatchId> order_;
  std::vector<Node> nodes_;
  double margin_ = 0;  // what roundings may move [m]
};

}  // namespace penumbra
