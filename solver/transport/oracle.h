// solver/transport/oracle.h
//
// Refinement oracles: which links carry too much error, and which end of them to split (thesis 4.4).

#pragma once

#include "solver/transport/solution.h"

namespace penumbra {

enum class Refinement { kAccept, kSplitReceiver, kSplitSource };

// Judges links. Further oracles are further classes.
class RefinementOracle {
 public:
  virtual ~RefinementOracle() = default;
  // What to do about the link, given the radiosities of the solution so far. Safe from several threads.
  virtual Refinement Judge(const RadiositySolution& solution, const Link& link) const = 0;
};

// Transport error (thesis 4.4.1), in W/m^2 of irradiance, for the largest channel. Our point form factors are
// exact whatever the size of the source, so that a link errs in two ways only: the receiver's irradiance
// varies over it, B x variation(F), and the source's radiosity varies over its leaves, F x spread(B). The
// larger of the two is split if it exceeds eps. (The thesis splits the larger element.)
class TransportOracle : public RefinementOracle {
 public:
  TransportOracle(double eps, double min_area) : eps_(eps), min_area_(min_area) {}
  Refinement Judge(const RadiositySolution& solution, const Link& link) const override;

 private:
  double eps_;       // [W/m^2]
  double min_area_;  // [m^2]: no receiver smaller than four times this is split
};

}  // namespace penumbra
