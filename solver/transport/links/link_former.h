// solver/transport/links/link_former.h
//
// Makes links between elements. The blockers of a child link are those blockers of the parent link that
// intersect the child's tube, the convex hull of source and receiver (Teller and Hanrahan 1993). A
// LinkFormFactorMethod computes the form factors of the links.

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/link_form_factor_method.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// A source element that may be linked to a receiver, with the blockers of the parent link.
struct LinkCandidate {
  ElementId source = kNoElement;
  std::span<const PatchId> blockers;
};

// Makes the links of one receiver to all candidate sources that the receiver may see, in the order of the
// candidates. Link::first_blocker of the first link is 0. Candidate sources that do not face the receiver, or
// that one blocker hides completely, get no link. The form factor of a link is the mean over the whole
// receiver; points of the receiver behind the source's plane contribute 0. If the computation is cancelled
// (ExecutionContext), the links must not be used.
LinkSet FormLinks(const ElementForest& forest, ElementId receiver, std::span<const LinkCandidate> candidates,
                  const LinkFormFactorMethod& form_factors,
                  const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
