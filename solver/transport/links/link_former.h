// solver/transport/links/link_former.h
//
// Makes links: chooses the blockers of a child link from those of its parent by the child's own tube (Teller
// and Hanrahan 1993), and computes the form factors by a given method.

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/link_form_factor_method.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// A source to link to a receiver, with the blockers of the parent link.
struct LinkCandidate {
  ElementId source = kNoElement;
  std::span<const PatchId> blockers;
};

// The links of one receiver to all candidates that it may see, in the order of the candidates; first_blocker
// starts at 0. Candidates that do not face the receiver, or that one blocker hides completely, get no link.
// Points of the receiver behind the source's plane count as dark: the form factor is that of the whole
// receiver. The result is useless if the context is cancelled.
LinkSet FormLinks(const ElementForest& forest, ElementId receiver, std::span<const LinkCandidate> candidates,
                  const LinkFormFactorMethod& form_factors,
                  const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
