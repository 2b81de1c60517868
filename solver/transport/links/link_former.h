// solver/transport/links/link_former.h
//
// Makes links. The blockers of a child link are those blockers of the parent link that intersect the child's
// own tube (Teller and Hanrahan 1993). A given method computes the form factors.

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/link_form_factor_method.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// A source that may be linked to a receiver, with the blockers of the parent link.
struct LinkCandidate {
  ElementId source = kNoElement;
  std::span<const PatchId> blockers;
};

// The links of one receiver to all candidates that the receiver may see, in the order of the candidates.
// Link::first_blocker of the first link is 0. Candidates that do not face the receiver, or that one blocker
// hides completely, get no link. The form factor is the mean over the whole receiver; points of the receiver
// behind the source's plane contribute 0. The result is useless if the context is cancelled.
LinkSet FormLinks(const ElementForest& forest, ElementId receiver, std::span<const LinkCandidate> candidates,
                  const LinkFormFactorMethod& form_factors,
                  const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
