// solver/transport/links/area_weighted_oracle.h
//
// Oracles that estimate the transport error of a link (thesis 4.4.1), in W/m^2 of irradiance, for the largest
// channel. Point form factors are exact here for sources of any size, so a link has two errors only. The
// receiver's irradiance varies over the receiver by B * deviation(F). The source's radiosity varies within
// the source's quarters, by F * spread(B) * variation(F). The oracle multiplies both errors by sqrt(receiver
// area / reference area). The sum of squared errors then equals the error over the scene, and refinement ends
// along edges where walls meet, where form factors vary at every size. The error of an element of the
// reference area is at most eps.

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// Splits the end of the link that causes the larger error. Derived classes define the deviation of the form
// factor.
class AreaWeightedOracle : public RefinementOracle {
 public:
  explicit AreaWeightedOracle(const OracleOptions& options) : options_(options) {}

  Refinement Judge(const RadiositySolution& solution, const Link& link) const final;

 private:
  // The root mean square deviation of the point form factors over the receiver [1].
  virtual double Deviation(const ElementForest& forest, const Link& link) const = 0;

  OracleOptions options_;
};

}  // namespace penumbra
