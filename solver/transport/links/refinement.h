// solver/transport/links/refinement.h
//
// Refinement of links (thesis 4.4): chooses the links that are split, and the links that replace them.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/transport/links/link_table.h"
#include "solver/transport/links/push_pull.h"
#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// New links, and the links that they replace. The spans LinkCandidate::blockers refer to memory of the
// solution's links.
struct RefinementPlan {
  std::vector<char> dropped;  // one flag for each link
  std::vector<LinkGroup> groups;
  std::size_t links_split = 0;
};

// Lets the oracle judge every link once. In the solution's forest, subdivides the elements that the oracle
// wants to split. REQUIRES: `push_pull` is up to date with the solution's links.
RefinementPlan PlanRefinement(RadiositySolution& solution, const PushPull& push_pull,
                              const RefinementOracle& oracle);

}  // namespace penumbra
