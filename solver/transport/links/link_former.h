// solver/transport/links/link_former.h
//
// Makes links: culls the blockers that a child inherits with its own tube (Teller and Hanrahan 1993), and has
// a method find their form factors.

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/link_form_factor_method.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// A source to be linked to a receiver, with what may block: the blockers of the parent link.
struct LinkCandidate {
  ElementId source = kNoElement;
  std::span<const PatchId> blockers;
};

// The links of one receiver to all candidates that it may see, in their order; `blockers` indices start at 0
// there. Candidates whose fronts do not face the receiver or which one blocker hides wholly get no link.
// Points of the receiver behind the source's plane count as dark, so that the form factor is that of the
// whole receiver. Of no use if it was cancelled.
LinkSet FormLinks(const ElementForest& forest, ElementId receiver, std::span<const LinkCandidate> candidates,
                  const LinkFormFactorMethod& form_factors,
                  const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
