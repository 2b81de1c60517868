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

// All new links of one receiver. New links choose their blockers from those of the links that they replace.
struct LinkGroup {
  ElementId receiver = kNoElement;
  std::vector<LinkCandidate> candidates;
};

// Forms the links of all groups, one set for each group. Sets are empty after the context is cancelled.
std::vector<LinkSet> FormLinkGroups(const ElementForest& forest, std::span<const LinkGroup> groups,
                                    const LinkFormFactorMethod& form_factors,
                                    const ExecutionContext& context);

// The links without a flag in `dropped` (one flag for each link; empty: no flags) and the links of `formed`,
// ordered by receiver, then source. The result is useless if the context is cancelled.
LinkSet ReplaceLinks(const LinkSet& links, std::span<const char> dropped, std::span<const LinkSet> formed,
                     const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
