// solver/transport/links/link_table.h
//
// Links in their order, and what replaces them.

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/link_former.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// All new links of one receiver. Their blockers are chosen from those of the links that they replace.
struct LinkGroup {
  ElementId receiver = kNoElement;
  std::vector<LinkCandidate> candidates;
};

// The links of all groups, a set each; empty ones once the context is cancelled.
std::vector<LinkSet> FormLinkGroups(const ElementForest& forest, std::span<const LinkGroup> groups,
                                    const LinkFormFactorMethod& form_factors,
                                    const ExecutionContext& context);

// The links that are not dropped (one flag a link; empty: none is) and those of `formed`, by receiver, then
// source. Of no use if it was cancelled.
LinkSet ReplaceLinks(const LinkSet& links, std::span<const char> dropped, std::span<const LinkSet> formed,
                     const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
