// solver/transport/links/refinement_oracle.h
//
// Refinement oracles: which links carry too much error, and which end of them to split (thesis 4.4).

#pragma once

#include <cstdint>

#include "solver/base/registry.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

enum class Refinement : std::uint8_t { kAccept, kSplitReceiver, kSplitSource };

// Judges links. An oracle is a class of its own in a file of its own; RefinementOracles() lists all.
class RefinementOracle {
 public:
  virtual ~RefinementOracle() = default;
  // What to do about the link, given the radiosities of the solution so far. Safe from several threads.
  virtual Refinement Judge(const RadiositySolution& solution, const Link& link) const = 0;
};

struct OracleOptions {
  double eps = 0.1;           // [W/m^2]
  double min_area = 1e-5;     // [m^2]: no element smaller than four times this is split
  double reference_area = 1;  // [m^2]: the area of an element for which eps is meant
};

using OracleRegistry = Registry<const RefinementOracle, OracleOptions>;

// Whether the children of the element would be no smaller than `min_area` [m^2], and its level not the last.
bool MaySplit(const Element& element, double min_area);

}  // namespace penumbra
