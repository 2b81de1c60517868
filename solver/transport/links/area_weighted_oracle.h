// solver/transport/links/area_weighted_oracle.h
//
// Oracles that estimate the transport error of a link (thesis 4.4.1), in W/m^2 of irradiance, for the largest
// channel. Point form factors are exact here whatever the size of the source, so that a link errs in two ways
// only: the receiver's irradiance varies over the receiver, by B x deviation(F), and the source's radiosity
// varies within the source's quarters, by F x spread(B) x variation(F). Both errors are multiplied by the
// square root of the receiver's area. Their squares then add up to the error over the scene, and the elements
// along edges where walls meet, whose form factors vary whatever their size, are not split for ever. The
// error of an element of the reference area is at most eps.

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// Splits the end of the link that causes the larger error. Derived classes say how much the form factor
// deviates.
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
