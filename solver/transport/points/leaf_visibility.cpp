#include "solver/transport/points/leaf_visibility.h"

#include <optional>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/visibility/pair/tube_blockers.h"

namespace penumbra {
namespace {

// Leaves are widened by these fractions of their own diameter and of their patch's diameter before tubes are
// made. A point on the border of two leaves then has the same blockers in both, including those that touch
// the border.
constexpr double kMargin = 0.01, kMarginOfPatch = 1e-5;

// Lists of blockers are narrowed if (leaves below) * (blockers) is at least this: a tube costs as much as
// about a hundred tests of a blocker from a point, and removes few blockers. 40 is best for eight points per
// leaf; 10 is not better for fifty points per leaf, in a refined mesh.
constexpr std::size_t kWorthwhile = 40;

Polygon3 Widened(std::span<const Vec3> polygon, double margin) {
  const Vec3 centre = Centroid(polygon);
  const double factor = 1 + margin / Diameter(polygon);
  Polygon3 wide;
  for (const Vec3& v : polygon) wide.push_back(centre + factor * (v - centre));
  return wide;
}

struct Lists {
  std::vector<PatchPair> pairs;
  std::vector<PatchId> blockers;

  std::span<const PatchId> Blockers(const PatchPair& pair) const {
    return {blockers.data() + pair.first_blocker, pair.blocker_count};
  }
};

// The lists of all leaves of one patch, depth first.
struct PatchLists {
  std::vector<ElementId> leaves;
  std::vector<Lists> lists;
};

void Keep(PatchPair pair, std::span<const PatchId> blockers, Lists& lists) {
  pair.first_blocker = static_cast<std::uint32_t>(lists.blockers.size());
  pair.blocker_count = static_cast<std::uint32_t>(blockers.size());
  pair.visibility = blockers.empty() ? Visibility::kVisible : Visibility::kPartial;
  lists.blockers.insert(lists.blockers.end(), blockers.begin(), blockers.end());
  lists.pairs.push_back(pair);
}

class Filter {
 public:
  Filter(const ElementForest& forest, const ExecutionContext& context)
      : forest_(forest), scene_(forest.scene()), context_(context), leaves_below_(forest.size(), 0) {
    for (std::size_t i = forest.size(); i-- > 0;) {  // children have larger numbers than their parents
      const Element& element = forest.elements()[i];
      if (element.IsLeaf()) leaves_below_[i] = 1;
      if (element.parent != kNoElement)
        leaves_below_[static_cast<std::size_t>(element.parent)] += leaves_below_[i];
    }
  }

  void Descend(ElementId id, const Lists& above, PatchLists& out) const {
    if (context_.Cancelled()) return;
    const Element& element = forest_[id];
    Lists own = Narrow(id, above);
    if (element.IsLeaf()) {
      out.leaves.push_back(id);
      out.lists.push_back(std::move(own));
      return;
    }
    for (ElementId child = element.first_child; child < element.first_child + 4; ++child)
      Descend(child, own, out);
  }

 private:
  Lists Narrow(ElementId id, const Lists& above) const {
    const Element& element = forest_[id];
    const std::size_t leaves = leaves_below_[static_cast<std::size_t>(id)];
    const Patch& patch = scene_.patches[element.patch];
    const double margin =
        kMargin * Diameter(element.Vertices()) + kMarginOfPatch * Diameter(patch.Vertices());
    const Polygon3 receiver = Widened(element.Vertices(), margin);
    Lists own;
    TubeBlockers found;
    for (PatchPair pair : above.pairs) {
      if (context_.Cancelled()) break;
      const std::span<const PatchId> blockers = above.Blockers(pair);
      if (leaves * blockers.size() < kWorthwhile) {
        Keep(pair, blockers, own);
        continue;
      }
      const Patch& source = scene_.patches[pair.source];
      const std::optional<TubeEnds> ends = ClipToEachOther(receiver, patch, source.Vertices(), source);
      if (!ends) continue;
      if (FindTubeBlockers(scene_, *ends, element.patch, pair.source, blockers, found))
        Keep(pair, found.first, own);
    }
    return own;
  }

  const ElementForest& forest_;
  const Scene& scene_;
  const ExecutionContext& context_;
  std::vector<std::size_t> leaves_below_;
};

}  // namespace

LeafVisibility::LeafVisibility(const ElementForest& forest, const PatchVisibility& patches,
                               const ExecutionContext& context)
    : range_(forest.size(), {0, 0}) {
  const std::size_t count = forest.scene().patches.size();
  std::vector<PatchLists> found(count);
  const Filter filter(forest, context);
  ParallelFor(count, 1, [&](std::size_t p) {
    if (context.Cancelled()) return;
    Lists root;
    for (const PatchPair& pair : patches.SourcesOf(static_cast<PatchId>(p)))
      Keep(pair, patches.Blockers(pair), root);
    filter.Descend(ElementForest::Root(static_cast<PatchId>(p)), root, found[p]);
  });
  for (PatchLists& patch : found) {
    if (context.Cancelled()) return;
    for (std::size_t i = 0; i < patch.leaves.size(); ++i) {
      const auto offset = static_cast<std::uint32_t>(blockers_.size());
      const std::size_t first = pairs_.size();
      for (PatchPair pair : patch.lists[i].pairs) {
        pair.first_blocker += offset;
        pairs_.push_back(pair);
      }
      blockers_.insert(blockers_.end(), patch.lists[i].blockers.begin(), patch.lists[i].blockers.end());
      range_[static_cast<std::size_t>(patch.leaves[i])] = {first, pairs_.size()};
    }
    patch = {};  // frees memory early
  }
}

std::shared_ptr<const LeafVisibility> LeafVisibilityCache::Get(const ElementForest& forest,
                                                               const PatchVisibility& patches,
                                                               const ExecutionContext& context) {
  if (!found_) {
    auto found = std::make_shared<const LeafVisibility>(forest, patches, context);
    if (context.Cancelled()) return nullptr;
    found_ = std::move(found);
  }
  return found_;
}

}  // namespace penumbra
