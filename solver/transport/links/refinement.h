// solver/transport/links/refinement.h
//
// Refinement of links between elements (thesis 4.4): chooses the links to be split, and the new links that
// replace the split links.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/transport/links/link_table.h"
#include "solver/transport/links/push_pull.h"
#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// A plan of refinement: the new links, and the old links that the new links replace. The spans
// LinkCandidate::blockers refer to memory of the solution's links.
struct RefinementPlan {
  std::vector<char> dropped;  // dropped[l] is 1 if old link l is replaced
  std::vector<LinkGroup> groups;
  std::size_t links_split = 0;
};

// Lets the refinement oracle judge every link once, and subdivides the elements of the solution's forest that
// the oracle wants to split. REQUIRES: PushPull::Update() was called after the last change of the solution's
// links.
RefinementPlan PlanRefinement(RadiositySolution& solution, const PushPull& push_pull,
                              const RefinementOracle& oracle);

}  // namespace penumbra
