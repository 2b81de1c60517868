// solver/transport/links/refinement_oracle.h
//
// Refinement oracles decide which links between elements have too large an error, and whether the receiver or
// the source of an inaccurate link must be split (thesis 4.4).

#pragma once

#include <cstdint>

#include "solver/base/registry.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

enum class Refinement : std::uint8_t { kAccept, kSplitReceiver, kSplitSource };

// The interface of refinement oracles, which judge links. RefinementOracles() lists all refinement oracles.
class RefinementOracle {
 public:
  virtual ~RefinementOracle() = default;
  // Decides, given the current radiosities of the solution, whether to accept the link, to split its receiver
  // or to split its source. Several threads may call Judge() at once.
  virtual Refinement Judge(const RadiositySolution& solution, const Link& link) const = 0;
};

struct OracleOptions {
  double eps = 0.1;  // largest allowed error of a link between elements [W/m^2]
  // The smallest allowed area of an element [m^2]; an element whose area is below 4 * min_area is not split.
  double min_area = 1e-5;
  // The oracle compares (link error) * sqrt((receiver area) / reference_area) with eps; reference_area is an
  // area [m^2].
  double reference_area = 1;
};

using OracleRegistry = Registry<const RefinementOracle, OracleOptions>;

// True if the children of the element would have at least the area `min_area` [m^2], and the level of the
// element is below kMaxLevel.
bool MaySplit(const Element& element, double min_area);

}  // namespace penumbra
