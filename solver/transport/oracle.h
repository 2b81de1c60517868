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
// varies over it, B x variation(F), and the source's radiosity varies within its quarters, F x spread(B) x
// variation(F). Both count by the square root of the receiver's area, so that the squares add up to the error
// over the scene, and the elements along edges where walls meet, whose form factors vary whatever their size,
// are not split for ever. An element of reference area errs by at most eps. (The thesis compares with eps
// without the area, and splits the larger element.)
class TransportOracle : public RefinementOracle {
 public:
  TransportOracle(double eps, double min_area, double reference_area)
      : eps_(eps), min_area_(min_area), reference_area_(reference_area) {}
  Refinement Judge(const RadiositySolution& solution, const Link& link) const override;

 private:
  double eps_;             // [W/m^2]
  double min_area_;        // [m^2]: no receiver smaller than four times this is split
  double reference_area_;  // [m^2]
};

}  // namespace penumbra
