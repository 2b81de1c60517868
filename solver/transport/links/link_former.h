// solver/transport/links/link_former.h
//
// Makes links: culls the blockers that a child inherits with its own tube (Teller and Hanrahan 1993) and
// averages exact point form factors over the receiver (thesis 4.2, method 3), occlusion exact.

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// How the form factor of a link is found. Its variation and the shares of the source's quarters come from the
// points of the cubature either way.
enum class LinkFormFactors {
  kCubature,  // the mean over a few points of the receiver
  kExact,     // between areas (AreaFormFactor), to kExactLinkTolerance: sums and reciprocity hold to that
  // The source as a disk, seen from the centre of the receiver's part before it, times the share of it that
  // blockers leave there, exactly (Hanrahan, Salzman and Aupperle 1991, who cast rays for that): to compare.
  kDisk,
};
inline constexpr double kExactLinkTolerance = 1e-7;  // of the factor, where something stands between
// Points that an exact link past blockers may cost.
inline constexpr std::size_t kExactLinkPoints = 100'000;

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
                  LinkFormFactors form_factors = LinkFormFactors::kCubature,
                  const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
