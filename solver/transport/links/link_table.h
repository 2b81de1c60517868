// solver/transport/links/link_table.h
//
// Operations on the ordered set of links: forming groups of new links, and replacing links.

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/link_former.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// All new links of one receiver. The blockers of a new link are chosen from the blockers of the link that it
// replaces.
struct LinkGroup {
  ElementId receiver = kNoElement;
  std::vector<LinkCandidate> candidates;
};

// Forms the links of all groups, one set for each group. If the context is cancelled, the remaining sets are
// empty.
std::vector<LinkSet> FormLinkGroups(const ElementForest& forest, std::span<const LinkGroup> groups,
                                    const LinkFormFactorMethod& form_factors,
                                    const ExecutionContext& context);

// The links l of `links` with dropped[l] == 0, together with the links of `formed`, ordered by receiver, then
// by source. If `dropped` is empty, all links are kept. The result is useless if the context is cancelled.
LinkSet ReplaceLinks(const LinkSet& links, std::span<const char> dropped, std::span<const LinkSet> formed,
                     const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
