// solver/visibility/patch_hierarchy.h
//
// A bounding hierarchy over patches: which of them may matter to a point, without a look at all the others.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/receiver_point.h"

namespace penumbra {

// All p with normal . p >= offset; the normal is unit.
struct HalfSpace {
  Vec3 normal = Vec3::Zero();
  double offset = 0;  // [m]
};

// A convex region: what lies in all of its half-spaces.
using ConvexRegion = std::vector<HalfSpace>;

class PatchHierarchy {
 public:
  PatchHierarchy() = default;
  // Over the given patches of the scene; their boxes are copied.
  PatchHierarchy(const Scene& scene, std::vector<PatchId> patches);

  std::size_t size() const { return order_.size(); }

  // Replaces `found` by the patches whose boxes reach into the region and do not lie in one of the shadows as
  // a whole, ascending. Roundings count for the patches: some that just miss the region may be among them.
  void Find(const ConvexRegion& region, std::span<const ConvexRegion> shadows,
            std::vector<PatchId>& found) const;

  // Replaces `found` by up to `count` patches that fill, by an estimate, the largest part of what is seen
  // from `eye`, and at least `least` [sr] each.
  void FindLargest(const Vec3& eye, double least, std::size_t count, std::vector<PatchId>& found) const;

 private:
  // In depth-first order; children follow their parent. A leaf has one patch.
  struct Node {
    Vec3 centre, half;                  // of its box [m]
    std::int32_t skip = 1;              // nodes in this subtree, this one counted
    std::int32_t first = 0, count = 0;  // its patches, in order_
  };
  struct Disc {
    Vec3 centre, area;  // area times normal [m^2]
  };

  void Build(const Scene& scene, std::size_t first, std::size_t last);

  std::vector<PatchId> order_;
  std::vector<Disc> disc_;  // of the patches, in the same order
  std::vector<Node> nodes_;
  double margin_ = 0;  // what roundings may move [m]
};

// Where nothing is seen from the point because the patch stands before it; empty if its plane contains the
// point.
ConvexRegion ShadowRegion(const ReceiverPoint& at, const Patch& patch);

}  // namespace penumbra
