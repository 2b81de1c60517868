#include "solver/transport/links/refinement.h"

#include <utility>

#include "solver/base/parallel.h"

namespace penumbra {
namespace {

constexpr std::size_t kJudgeGrain = 256;  // links in one task

ElementId FirstChild(ElementForest& forest, ElementId element) {
  return forest[element].IsLeaf() ? forest.Subdivide(element) : forest[element].first_child;
}

// The new links of one receiver.
struct Split {
  std::vector<LinkCandidate> down;  // links of its children
  std::vector<LinkCandidate> here;  // links of the receiver itself
};

void AddGroups(ElementForest& forest, ElementId receiver, Split split, std::vector<LinkGroup>& groups) {
  if (!split.down.empty()) {
    const ElementId first = FirstChild(forest, receiver);
    for (ElementId child = first; child < first + 4; ++child) groups.push_back({child, split.down});
  }
  if (!split.here.empty()) groups.push_back({receiver, std::move(split.here)});
}

}  // namespace

RefinementPlan PlanRefinement(RadiositySolution& solution, const PushPull& push_pull,
                              const RefinementOracle& oracle) {
  const std::vector<Link>& links = solution.links.links;
  std::vector<Refinement> verdict(links.size());
  ParallelFor(links.size(), kJudgeGrain,
              [&](std::size_t i) { verdict[i] = oracle.Judge(solution, links[i]); });

  RefinementPlan plan;
  plan.dropped.assign(links.size(), 0);
  const auto receivers = static_cast<ElementId>(solution.forest.size());
  for (ElementId receiver = 0; receiver < receivers; ++receiver) {
    Split split;
    for (std::size_t i = push_pull.FirstLink(receiver); i < push_pull.EndLink(receiver); ++i) {
      if (verdict[i] == Refinement::kAccept) continue;
      plan.dropped[i] = 1;
      ++plan.links_split;
      const std::span<const PatchId> blockers = solution.links.Blockers(links[i]);
      if (verdict[i] == Refinement::kSplitReceiver) {
        split.down.push_back({links[i].source, blockers});
      } else {
        const ElementId first = FirstChild(solution.forest, links[i].source);
        for (ElementId child = first; child < first + 4; ++child) split.here.push_back({child, blockers});
      }
    }
    AddGroups(solution.forest, receiver, std::move(split), plan.groups);
  }
  return plan;
}

}  // namespace penumbra
