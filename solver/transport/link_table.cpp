#include "solver/transport/link_table.h"

#include <algorithm>
#include <utility>

#include "solver/base/parallel.h"

namespace penumbra {
namespace {

constexpr std::size_t kLinkGrain = 2;  // receivers that a task links

}  // namespace

std::vector<LinkSet> FormLinkGroups(const ElementForest& forest, std::span<const LinkGroup> groups,
                                    LinkFormFactors form_factors, const ExecutionContext& context) {
  std::vector<LinkSet> formed(groups.size());
  ParallelFor(groups.size(), kLinkGrain, [&](std::size_t g) {
    if (!context.Cancelled())
      formed[g] = FormLinks(forest, groups[g].receiver, groups[g].candidates, form_factors);
  });
  return formed;
}

LinkSet ReplaceLinks(const LinkSet& links, std::span<const char> dropped, std::span<const LinkSet> formed) {
  struct Origin {
    const LinkSet* set;
    const Link* link;
  };
  std::vector<Origin> origins;
  for (std::size_t i = 0; i < links.links.size(); ++i)
    if (dropped.empty() || !dropped[i]) origins.push_back({&links, &links.links[i]});
  for (const LinkSet& set : formed)
    for (const Link& link : set.links) origins.push_back({&set, &link});
  std::sort(origins.begin(), origins.end(), [](const Origin& a, const Origin& b) {
    return std::pair(a.link->receiver, a.link->source) < std::pair(b.link->receiver, b.link->source);
  });

  LinkSet merged;
  merged.links.reserve(origins.size());
  for (const Origin& origin : origins) {
    Link link = *origin.link;
    const std::span<const PatchId> blockers = origin.set->Blockers(link);
    link.first_blocker = static_cast<std::uint32_t>(merged.blockers.size());
    merged.blockers.insert(merged.blockers.end(), blockers.begin(), blockers.end());
    merged.links.push_back(link);
  }
  return merged;
}

}  // namespace penumbra
