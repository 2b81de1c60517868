#include "mesh/discontinuities/dset.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "mesh/discontinuities/discontinuity_choices.h"
#include "mesh/discontinuities/leaf_lines.h"
#include "mesh/discontinuities/line_jumps.h"
#include "solver/base/check.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

// For each discontinuity, the line on which it lies. Grouping starts with the longest discontinuity, so that
// a line's direction is at least as accurate as the direction of any discontinuity that joins the line.
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

// The order of activation: the heaviest first; of equal weights, the first found. Weights fall while lines
// become active. Therefore an entry that is still the heaviest after an update of its own weight is the
// heaviest of all. A weight that rises keeps its earlier value.
class ActivationOrder {
 public:
  using Weigh = std::function<double(std::size_t)>;

  // With `weigh`, the order uses updated weights.
  ActivationOrder(std::vector<double> weight, double least, Weigh weigh)
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

// Activates the discontinuities of one patch in order.
class Activator {
 public:
  Activator(const ElementForest& forest, PatchId patch, std::span<const Discontinuity> found,
            const DiscontinuityOptions& options, const ActivationRules& rules)
      : patch_(patch),
        found_(found),
        options_(options),
        choice_(DiscontinuityChoices().Make(options.choice)),
        filter_(rules.filter),
        at_place_(rules.at_place),
        lines_(forest, patch, choice_->MostLines(options)),
        grouped_(GroupCollinear(found, SnapDistance(forest.scene().patches[patch]))),
        number_(grouped_.lines.size(), -1),
        tried_(found.size()) {
    for (const ElementId leaf : lines_.leaves()) scale_.push_back(rules.scale ? rules.scale(leaf) : 1);
  }

  PatchDSets Run() {
    ActivationOrder order = Rank();
    while (const std::optional<std::size_t> next = order.Next()) Try(*next);
    if (options_.can_want()) FindOmitted();
    return Finish();
  }

 private:
  bool IsContact(std::size_t i) const { return found_[i].kind == DiscontinuityKind::kContact; }

  ActivationOrder Rank() {
    if (std::optional<DiscontinuityRanks> ranks = choice_->Rank(patch_, found_, options_))
      return {std::move(ranks->rank), ranks->least, {}};
    const double least = options_.min_weight;
    std::vector<double> weight(found_.size());
    ActivationOrder::Weigh weigh;
    if (options_.weight == DiscontinuityWeight::kThesis) {
      for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = found_[i].weight;
    } else {
      const LineJumps jumps(found_, grouped_.line_of, grouped_.lines);
      for (std::size_t i = 0; i < weight.size(); ++i) {
        const std::int32_t line = grouped_.line_of[i];
        lines_.Describe(found_[i], jumps, grouped_.lines[line], line, scale_, &omission_);
      }
      weigh = [this, least](std::size_t i) {
        if (IsContact(i)) return kInfiniteWeight;
        const OmissionCost::Cost cost =
            omission_.Of(i, number_[grouped_.line_of[i]], lines_.inside(), result_.lines);
        const bool enough = found_[i].wanted || cost.at_most >= least;
        return enough ? std::max(cost.by_place, least) : cost.by_place;
      };
      const auto weigh_all = [&] {
        for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = weigh(i);
      };
      weigh_all();
      if (at_place_) {
        ScaleInCrowds(weight);
        weigh_all();
      }
    }
    return {std::move(weight), least, std::move(weigh)};
  }

  // Ranks lines in the dark places of a leaf first, where lines compete for the room in the leaf. A line of
  // sufficient weight for the leaf as a whole remains a candidate, and may use the room that is left.
  void ScaleInCrowds(std::span<const double> weight) {
    std::vector<std::vector<std::int32_t>> competing(lines_.leaves().size());
    for (std::size_t i = 0; i < weight.size(); ++i) {
      if (weight[i] < options_.min_weight) continue;
      for (const Impinged& leaf : lines_.Meet(found_[i]))
        if (leaf.inside) competing[leaf.leaf].push_back(grouped_.line_of[i]);
    }
    for (std::vector<std::int32_t>& lines : competing) {
      std::sort(lines.begin(), lines.end());
      lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    }
    omission_.Rescale([&](const OmittedPart& part, double scale) {
      return competing[part.leaf].size() > static_cast<std::size_t>(options_.max_leaf_dsets)
                 ? at_place_(lines_.leaves()[part.leaf], 0.5 * (part.from + part.to))
                 : scale;
    });
  }

  // Activates the discontinuity where possible.
  void Try(std::size_t i) {
    tried_[i] = true;
    std::int32_t& line = number_[grouped_.line_of[i]];
    const auto candidate = line >= 0 ? line : static_cast<std::int32_t>(result_.lines.size());
    if (!Join(i, candidate)) return;
    ++result_.activated;
    if (line < 0) {
      line = candidate;
      result_.lines.push_back(grouped_.lines[grouped_.line_of[i]]);
    }
    const Discontinuity& d = found_[i];
    DiscontinuityLine& drawn = result_.lines[line];
    const double t0 = drawn.Along(d.end[0]), t1 = drawn.Along(d.end[1]);
    const LineInterval interval = {std::min(t0, t1), std::max(t0, t1)};
    drawn.cover.push_back(interval);
    if (d.degree == DiscontinuityDegree::kD0) drawn.contact.push_back(interval);
  }

  // Adds the line to the leaves that the discontinuity meets. Returns true if any leaf took the line.
  bool Join(std::size_t i, std::int32_t line) {
    const bool leaf_by_leaf = filter_ && !IsContact(i);
    const std::span<const Impinged> impinged = lines_.Meet(found_[i]);
    std::vector<ElementId> full;
    std::size_t room = 0;
    for (const Impinged& leaf : impinged) {
      if (lines_.Full(leaf, line)) {
        full.push_back(lines_.leaves()[leaf.leaf]);
      } else if (leaf.inside) {
        ++room;
      }
    }
    bool joined = false;
    for (const Impinged& leaf : impinged) {
      const bool may = leaf_by_leaf
                           ? !lines_.Full(leaf, line) && filter_(found_[i], lines_.leaves()[leaf.leaf])
                           : full.empty();
      if (!may) continue;
      lines_.Join(leaf, line);
      joined = true;
    }
    if (!full.empty() && !joined) {
      ++result_.refused;
      if (IsContact(i)) ++result_.refused_contacts;
      if (IsContact(i) || full.size() <= room)
        result_.crowded.insert(result_.crowded.end(), full.begin(), full.end());
    }
    return joined;
  }

  // Lists the discontinuities that were too light, although their leaves have room for them.
  void FindOmitted() {
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const std::int32_t line = number_[grouped_.line_of[i]];
      if (tried_[i] || lines_.Crowds(found_[i], line)) continue;
      OmittedDiscontinuity omitted;
      omitted.number = i;
      omitted.leaves = omission_.LeavesOf(i);
      omitted.parts =
          omission_.PartsWithout(i, line, lines_.inside(), result_.lines, options_.min_wanted_weight);
      if (!omitted.parts.empty()) result_.omitted.push_back(std::move(omitted));
    }
  }

  PatchDSets Finish() {
    for (DiscontinuityLine& line : result_.lines) {
      Unite(line.cover);
      Unite(line.contact);
    }
    std::sort(result_.crowded.begin(), result_.crowded.end());
    result_.crowded.erase(std::unique(result_.crowded.begin(), result_.crowded.end()), result_.crowded.end());
    result_.most_merged = lines_.most_merged();
    for (const auto& lines : lines_.inside()) result_.dsets_active += lines.size();
    result_.leaves.assign(lines_.leaves().begin(), lines_.leaves().end());
    result_.leaf_lines.assign(lines_.touching().begin(), lines_.touching().end());
    for (auto& lines : result_.leaf_lines) std::sort(lines.begin(), lines.end());
    return std::move(result_);
  }

  const PatchId patch_;
  const std::span<const Discontinuity> found_;
  const DiscontinuityOptions& options_;
  const std::unique_ptr<const DiscontinuityChoiceMethod> choice_;
  const LeafFilter& filter_;
  const PlaceScale& at_place_;
  LeafLines lines_;
  const Lines grouped_;
  std::vector<std::int32_t> number_;  // of each of grouped_.lines: index in result_.lines; -1: not active
  std::vector<bool> tried_;
  std::vector<double> scale_;  // factors of errors, per leaf
  OmissionCost omission_;
  PatchDSets result_;
};

}  // namespace

PatchDSets ActivateDiscontinuities(const ElementForest& forest, PatchId patch,
                                   std::span<const Discontinuity> found, const DiscontinuityOptions& options,
                                   const ActivationRules& rules) {
  PENUMBRA_CHECK(options.max_leaf_dsets >= 0);
  if (!options.enabled()) found = {};
  return Activator(forest, patch, found, options, rules).Run();
}

}  // namespace penumbra
