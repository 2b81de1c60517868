// solver/transport/links/refinement.h
//
// Refinement of links (thesis 4.4): what is split, and which links come in its place.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/transport/links/link_table.h"
#include "solver/transport/links/push_pull.h"
#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// Links to be formed, and those whose place they take. The groups' blockers are those of the solution's
// links.
struct RefinementPlan {
  std::vector<char> dropped;  // a flag a link
  std::vector<LinkGroup> groups;
  std::size_t links_split = 0;
};

// Judges all links once, and splits the elements that the oracle wants to be split in the solution's forest.
// `push_pull` knows the solution's links.
RefinementPlan PlanRefinement(RadiositySolution& solution, const PushPull& push_pull,
                              const RefinementOracle& oracle);

}  // namespace penumbra
