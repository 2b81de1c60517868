// solver/transport/links/link_table.h
//
// Operations on the ordered set of links between elements: forming groups of new links, and replacing links.

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/link_former.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// All new links of one receiver. The blockers of a new link are chosen from the blockers of the old link that
// the new link replaces.
struct LinkGroup {
  ElementId receiver = kNoElement;
  std::vector<LinkCandidate> candidates;
};

// Forms the links of all groups, one LinkSet for each group. If the computation is cancelled
// (ExecutionContext), the LinkSets of groups whose links were not yet formed are empty.
std::vector<LinkSet> FormLinkGroups(const ElementForest& forest, std::span<const LinkGroup> groups,
                                    const LinkFormFactorMethod& form_factors,
                                    const ExecutionContext& context);

// Returns all links l of `links` with dropped[l] == 0, and all links of `formed`, ordered by receiver, then
// by source. If `dropped` is empty, all links of `links` are kept. If the computation is cancelled
// (ExecutionContext), the links must not be used.
LinkSet ReplaceLinks(const LinkSet& links, std::span<const char> dropped, std::span<const LinkSet> formed,
                     const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
