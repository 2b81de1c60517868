#include "mesh/dset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "mesh/leaf_margins.h"
#include "mesh/line_jumps.h"
#include "mesh/omission_cost.h"
#include "solver/base/check.h"
#include "solver/base/random.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

// For each discontinuity the line that it lies on. Longest first: a line's direction is then known at least
// as well as that of any segment that joins it.
struct Lines {
  std::vector<DiscontinuityLine> lines;
  std::vector<std::int32_t> line_of;
};

Lines GroupCollinear(std::span<const Discontinuity> found, double tolerance) {
  Lines result;
  result.line_of.resize(found.size());
  std::vector<std::size_t> order(found.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> length(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) length[i] = (found[i].end[1] - found[i].end[0]).norm();
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return length[a] > length[b]; });
  for (const std::size_t i : order) {
    const auto& [a, b] = found[i].end;
    const auto holds = [&](const DiscontinuityLine& line) {
      return std::abs(line.Distance(a)) <= tolerance && std::abs(line.Distance(b)) <= tolerance;
    };
    const auto line = std::find_if(result.lines.begin(), result.lines.end(), holds);
    result.line_of[i] = static_cast<std::int32_t>(line - result.lines.begin());
    if (line == result.lines.end()) result.lines.push_back({{a, (b - a) / length[i]}, {}, {}});
  }
  return result;
}

void Unite(std::vector<LineInterval>& intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const LineInterval& a, const LineInterval& b) {
    return std::pair(a.t0, a.t1) < std::pair(b.t0, b.t1);
  });
  std::size_t kept = 0;
  for (const LineInterval& i : intervals) {
    if (kept > 0 && i.t0 <= intervals[kept - 1].t1) {
      intervals[kept - 1].t1 = std::max(intervals[kept - 1].t1, i.t1);
    } else {
      intervals[kept++] = i;
    }
  }
  intervals.resize(kept);
}

// A leaf on which a discontinuity impinges.
struct Impinged {
  std::size_t leaf;  // index in PatchDSets::leaves
  bool inside;       // it crosses the leaf's inside, not just its border
};

// Activates discontinuities one by one on the leaves of a patch.
class Activation {
 public:
  Activation(const ElementForest& forest, PatchId patch, std::size_t max_leaf_dsets)
      : forest_(forest),
        frame_(PolygonFrame(forest.scene().patches[patch].Vertices())),
        snap_(SnapDistance(forest.scene().patches[patch])),
        max_leaf_dsets_(max_leaf_dsets),
        root_(BuildNode(ElementForest::Root(patch))) {
    touching.resize(leaves.size());
    merged_.resize(leaves.size());
    inside_.resize(leaves.size());
  }

  // The leaves that the discontinuity meets, until the next call.
  std::span<const Impinged> Meet(const Discontinuity& d) {
    impinged_.clear();
    Descend(root_, d.end[0], d.end[1]);
    return impinged_;
  }

  // Tells what leaving it out costs where it crosses the inside of a leaf.
  void Describe(const Discontinuity& d, const LineJumps& jumps, const DirectedLine& line, std::int32_t number,
                OmissionCost* cost) {
    cost->Begin();
    const double length = (d.end[1] - d.end[0]).norm();
    const Vec2 along = (d.end[1] - d.end[0]) / length;
    for (const Impinged& i : Meet(d)) {
      if (!i.inside) continue;
      const Polygon2& outline = nodes_[node_of_leaf_[i.leaf]].outline;
      const LineInterval part = ClipLine(d.end[0], along, outline, 0);
      const Vec2 a = d.end[0] + std::max(part.t0, 0.0) * along;
      const Vec2 b = d.end[0] + std::min(part.t1, length) * along;
      cost->AddPart(i.leaf, outline, forest_[leaves[i.leaf]].area, a, b,
                    jumps.At(number, line.Along(0.5 * (a + b))));
    }
  }

  // Per leaf, the lines that run through its inside, in order of activation.
  std::span<const std::vector<std::int32_t>> inside() const { return inside_; }

  bool Full(const Impinged& i, std::int32_t line) const {
    return i.inside && !Contains(inside_[i.leaf], line) && inside_[i.leaf].size() >= max_leaf_dsets_;
  }

  // Makes the line one of the leaf's.
  void Join(const Impinged& i, std::int32_t line) {
    if (i.inside && !Contains(inside_[i.leaf], line)) inside_[i.leaf].push_back(line);
    std::vector<std::int32_t>& lines = touching[i.leaf];
    const auto place = static_cast<std::size_t>(std::find(lines.begin(), lines.end(), line) - lines.begin());
    if (place == lines.size()) {
      lines.push_back(line);
      merged_[i.leaf].push_back(0);
    }
    most_merged_ = std::max(most_merged_, ++merged_[i.leaf][place]);
  }

  std::size_t most_merged() const { return most_merged_; }

  std::size_t InsideCount() const {
    std::size_t count = 0;
    for (const auto& lines : inside_) count += lines.size();
    return count;
  }

  std::vector<ElementId> leaves;
  std::vector<std::vector<std::int32_t>> touching;  // per leaf, in order of activation

 private:
  struct Node {
    Polygon2 outline;
    std::int32_t first_child = -1;  // in nodes_; -1: a leaf
    std::size_t leaf = 0;           // index in `leaves`
  };

  static bool Contains(const std::vector<std::int32_t>& lines, std::int32_t line) {
    return std::find(lines.begin(), lines.end(), line) != lines.end();
  }

  std::int32_t BuildNode(ElementId id) {
    nodes_.push_back({LeafOutline(forest_[id], frame_)});
    FillNode(0, id);
    return 0;
  }

  void FillNode(std::int32_t index, ElementId id) {
    if (forest_[id].IsLeaf()) {
      nodes_[index].leaf = leaves.size();
      leaves.push_back(id);
      node_of_leaf_.push_back(index);
      return;
    }
    const auto first = static_cast<std::int32_t>(nodes_.size());
    nodes_[index].first_child = first;
    const ElementId child = forest_[id].first_child;
    for (ElementId c = child; c < child + 4; ++c) nodes_.push_back({LeafOutline(forest_[c], frame_)});
    for (std::int32_t c = 0; c < 4; ++c) FillNode(first + c, child + c);
  }

  void Descend(std::int32_t index, const Vec2& a, const Vec2& b) {
    const Node& node = nodes_[index];
    const double length = (b - a).norm();
    const auto meets = [&](double inset) {
      const LineInterval clip = ClipLine(a, (b - a) / length, node.outline, inset);
      return std::max(clip.t0, 0.0) <= std::min(clip.t1, length);
    };
    if (!meets(-kLeafMargin * snap_)) return;
    if (node.first_child < 0) {
      impinged_.push_back({node.leaf, meets(kLeafMargin * snap_)});
      return;
    }
    for (std::int32_t c = 0; c < 4; ++c) Descend(node.first_child + c, a, b);
  }

  const ElementForest& forest_;
  Frame frame_;
  double snap_;
  std::size_t max_leaf_dsets_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> node_of_leaf_;
  std::int32_t root_;
  std::vector<std::vector<std::int32_t>> inside_;
  std::vector<std::vector<std::size_t>> merged_;  // discontinuities of each line of `touching`
  std::size_t most_merged_ = 0;
  std::vector<Impinged> impinged_;
};

}  // namespace

bool Covers(std::span<const LineInterval> intervals, double t, double reach) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [&](const LineInterval& i) { return t >= i.t0 - reach && t <= i.t1 + reach; });
}

Polygon2 LeafOutline(const Element& leaf, const Frame& frame) {
  Polygon2 outline;
  outline.reserve(4);
  for (const Vec3& v : leaf.Vertices()) outline.push_back(frame.ToPlane(v));
  return outline;
}

LineInterval ClipLine(const Vec2& origin, const Vec2& direction, const Polygon2& outline, double inset) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  LineInterval clip = {-kInfinity, kInfinity};
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2& a = outline[k];
    const Vec2 side = (outline[(k + 1) % outline.size()] - a).normalized();
    const double depth = Cross2(side, origin - a) - inset;  // of the origin within the half-plane
    const double rate = Cross2(side, direction);
    if (rate == 0) {
      if (depth < 0) return {1, 0};
    } else if (rate > 0) {
      clip.t0 = std::max(clip.t0, -depth / rate);
    } else {
      clip.t1 = std::min(clip.t1, -depth / rate);
    }
  }
  return clip;
}

namespace {

// Those to be tried, one after the other: the heaviest first, of equal weight the one found first. Weights
// fall while lines are activated, so that one that is still the heaviest after it has been weighed again is;
// one that rose would count as it was.
class Order {
 public:
  using Weigh = std::function<double(std::size_t)>;

  // With `weigh` weights are those of the moment.
  Order(std::vector<double> weight, double least, Weigh weigh)
      : weight_(std::move(weight)), least_(least), weigh_(std::move(weigh)) {
    for (std::size_t i = 0; i < weight_.size(); ++i)
      if (weight_[i] >= least_) heap_.push_back(i);
    std::make_heap(heap_.begin(), heap_.end(), Later());
  }

  std::optional<std::size_t> Next() {
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), Later());
      const std::size_t i = heap_.back();
      heap_.pop_back();
      if (!weigh_) return i;
      const double now = std::min(weight_[i], weigh_(i));
      if (now == weight_[i]) return i;
      weight_[i] = now;
      if (now < least_) continue;
      heap_.push_back(i);
      std::push_heap(heap_.begin(), heap_.end(), Later());
    }
    return std::nullopt;
  }

 private:
  std::function<bool(std::size_t, std::size_t)> Later() const {
    return [this](std::size_t a, std::size_t b) {
      return weight_[a] != weight_[b] ? weight_[a] < weight_[b] : a > b;
    };
  }

  std::vector<double> weight_;
  double least_;
  Weigh weigh_;
  std::vector<std::size_t> heap_;
};

}  // namespace

PatchDSets ActivateDiscontinuities(const ElementForest& forest, PatchId patch,
                                   std::span<const Discontinuity> found, const DiscontinuityOptions& options,
                                   const LeafFilter& filter) {
  PENUMBRA_CHECK(options.max_leaf_dsets >= 0);
  const bool adaptive = options.choice == DiscontinuityChoice::kAdaptive;
  PENUMBRA_CHECK(!adaptive || filter);
  PatchDSets result;
  Activation activation(forest, patch,
                        options.choice == DiscontinuityChoice::kAll
                            ? std::numeric_limits<std::size_t>::max()
                            : static_cast<std::size_t>(options.max_leaf_dsets));
  Lines grouped;
  if (options.enabled()) grouped = GroupCollinear(found, SnapDistance(forest.scene().patches[patch]));

  std::vector<std::int32_t> number(grouped.lines.size(), -1);  // of a line among the active ones
  std::vector<ElementId> full;
  std::vector<double> weight(options.enabled() ? found.size() : 0);
  double least = options.min_weight;
  OmissionCost omission;
  Order::Weigh weigh;
  if (options.choice == DiscontinuityChoice::kRandom) {
    Random random(options.seed, static_cast<std::uint64_t>(patch));
    least = 0;
    for (std::size_t i = 0; i < weight.size(); ++i) {
      const double place = random.Uniform();
      weight[i] = found[i].kind == DiscontinuityKind::kContact ? kInfiniteWeight : place;
    }
  } else if (options.choice == DiscontinuityChoice::kAll || options.weight == DiscontinuityWeight::kThesis) {
    if (options.choice == DiscontinuityChoice::kAll) least = 0;
    for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = found[i].weight;
  } else {
    const LineJumps jumps(found, grouped.line_of, grouped.lines);
    for (std::size_t i = 0; i < weight.size(); ++i) {
      const std::int32_t line = grouped.line_of[i];
      activation.Describe(found[i], jumps, grouped.lines[line], line, &omission);
    }
    weigh = [&](std::size_t i) {
      return found[i].kind == DiscontinuityKind::kContact
                 ? kInfiniteWeight
                 : omission.Of(i, number[grouped.line_of[i]], activation.inside(), result.lines);
    };
    for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = weigh(i);
  }
  Order order(std::move(weight), least, std::move(weigh));
  while (const std::optional<std::size_t> next = order.Next()) {
    const std::size_t i = *next;
    const Discontinuity& d = found[i];
    const bool contact = d.kind == DiscontinuityKind::kContact;
    std::int32_t& line = number[grouped.line_of[i]];
    const auto candidate = line >= 0 ? line : static_cast<std::int32_t>(result.lines.size());
    full.clear();
    std::size_t joined = 0, room = 0;
    const std::span<const Impinged> impinged = activation.Meet(d);
    for (const Impinged& leaf : impinged) {
      if (activation.Full(leaf, candidate)) {
        full.push_back(activation.leaves[leaf.leaf]);
      } else if (leaf.inside) {
        ++room;
      }
    }
    if (!adaptive || contact) {
      if (full.empty())
        for (const Impinged& leaf : impinged) {
          activation.Join(leaf, candidate);
          ++joined;
        }
    } else {
      for (const Impinged& leaf : impinged)
        if (!activation.Full(leaf, candidate) && filter(d, activation.leaves[leaf.leaf])) {
          activation.Join(leaf, candidate);
          ++joined;
        }
    }
    if (!full.empty() && joined == 0) {
      ++result.refused;
      if (contact) ++result.refused_contacts;
      if (contact || full.size() <= room)
        result.crowded.insert(result.crowded.end(), full.begin(), full.end());
    }
    if (joined == 0) continue;
    ++result.activated;
    if (line < 0) {
      line = candidate;
      result.lines.push_back(grouped.lines[grouped.line_of[i]]);
    }
    DiscontinuityLine& active = result.lines[line];
    const double t0 = active.Along(d.end[0]), t1 = active.Along(d.end[1]);
    const LineInterval interval = {std::min(t0, t1), std::max(t0, t1)};
    active.cover.push_back(interval);
    if (d.degree == DiscontinuityDegree::kD0) active.contact.push_back(interval);
  }
  for (DiscontinuityLine& line : result.lines) {
    Unite(line.cover);
    Unite(line.contact);
  }
  result.most_merged = activation.most_merged();
  std::sort(result.crowded.begin(), result.crowded.end());
  result.crowded.erase(std::unique(result.crowded.begin(), result.crowded.end()), result.crowded.end());
  result.dsets_active = activation.InsideCount();
  result.leaves = std::move(activation.leaves);
  result.leaf_lines = std::move(activation.touching);
  for (auto& lines : result.leaf_lines) std::sort(lines.begin(), lines.end());
  return result;
}

}  // namespace penumbra
