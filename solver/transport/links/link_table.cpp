#include "solver/transport/links/link_table.h"

#include <algorithm>
#include <utility>

#include "solver/base/processes.h"
#include "solver/geometry/vec_bytes.h"

namespace penumbra {
namespace {

constexpr std::size_t kLinkGrain = 2;  // receivers in one task

}  // namespace

std::vector<LinkSet> FormLinkGroups(const ElementForest& forest, std::span<const LinkGroup> groups,
                                    const LinkFormFactorMethod& form_factors,
                                    const ExecutionContext& context) {
  std::vector<LinkSet> formed(groups.size());
  const auto compute = [&](std::size_t g) {
    if (!context.Cancelled())
      formed[g] = FormLinks(forest, groups[g].receiver, groups[g].candidates, form_factors, context);
  };
  const auto transfer = [&](std::size_t g, auto& archive) {
    TransferPlain(archive, formed[g].links);
    TransferPlain(archive, formed[g].blockers);
  };
  DealOut({groups.size(), kLinkGrain, compute, transfer, transfer});
  return formed;
}

LinkSet ReplaceLinks(const LinkSet& links, std::span<const char> dropped, std::span<const LinkSet> formed,
                     const ExecutionContext& context) {
  struct Origin {
    const LinkSet* set;
    const Link* link;
  };
  const auto for_each = [&](const auto& take) {
    for (std::size_t i = 0; i < links.links.size(); ++i)
      if (dropped.empty() || !dropped[i]) take(Origin{&links, &links.links[i]});
    for (const LinkSet& set : formed)
      for (const Link& link : set.links) take(Origin{&set, &link});
  };
  std::vector<std::size_t> end;  // for each receiver, over all sets
  for_each([&](const Origin& origin) {
    const auto receiver = static_cast<std::size_t>(origin.link->receiver);
    if (receiver >= end.size()) end.resize(receiver + 1, 0);
    ++end[receiver];
  });
  std::size_t count = 0;
  for (std::size_t& place : end) place = std::exchange(count, count + place);
  std::vector<Origin> origins(count);
  for_each([&](const Origin& origin) {
    origins[end[static_cast<std::size_t>(origin.link->receiver)]++] = origin;
  });

  LinkSet merged;
  merged.links.reserve(count);
  for (std::size_t begin = 0, receiver = 0; receiver < end.size() && !context.Cancelled(); ++receiver) {
    const auto first = origins.begin() + static_cast<std::ptrdiff_t>(begin),
               last = origins.begin() + static_cast<std::ptrdiff_t>(end[receiver]);
    std::sort(first, last, [](const Origin& a, const Origin& b) { return a.link->source < b.link->source; });
    for (auto origin = first; origin != last; ++origin) {
      Link link = *origin->link;
      const std::span<const PatchId> blockers = origin->set->Blockers(link);
      link.first_blocker = static_cast<std::uint32_t>(merged.blockers.size());
      merged.blockers.insert(merged.blockers.end(), blockers.begin(), blockers.end());
      merged.links.push_back(link);
    }
    begin = end[receiver];
  }
  return merged;
}

}  // namespace penumbra
