// solver/transport/links/refinement_oracle.h
//
// Refinement oracles decide which links have too large an error, and which end of such a link, receiver or
// source, must be split (thesis 4.4).

#pragma once

#include <cstdint>

#include "solver/base/registry.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

enum class Refinement : std::uint8_t { kAccept, kSplitReceiver, kSplitSource };

// Judges links. Every oracle is a class in a file of its own; RefinementOracles() lists all oracles.
class RefinementOracle {
 public:
  virtual ~RefinementOracle() = default;
  // Decides, given the current radiosities of the solution, whether to accept the link or which of its ends
  // to split. May be called from several threads.
  virtual Refinement Judge(const RadiositySolution& solution, const Link& link) const = 0;
};

struct OracleOptions {
  double eps = 0.1;           // [W/m^2]
  double min_area = 1e-5;     // [m^2]; an element smaller than four times this is not split
  double reference_area = 1;  // [m^2]; area of an element for which eps is meant
};

using OracleRegistry = Registry<const RefinementOracle, OracleOptions>;

// True if the children of the element would have at least the area `min_area` [m^2], and the level of the
// element is below kMaxLevel.
bool MaySplit(const Element& element, double min_area);

}  // namespace penumbra
