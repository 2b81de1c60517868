// solver/transport/links/area_weighted_oracle.h
//
// Refinement oracles that estimate the transport error of a link between two elements (thesis 4.4.1), in
// W/m^2 of irradiance, for the largest channel. Because point form factors are exact for sources of any size,
// a link has only two errors: a receiver error and a source error. The receiver error, B * deviation(F) for
// source radiosity B and form factor F, arises because the irradiance varies over the receiver. The source
// error, F * spread(B) * variation(F) for source radiosity B and form factor F, arises because the radiosity
// varies within the source's quarters. The AreaWeightedOracle multiplies both errors of a link by
// sqrt(receiver area / reference area). A link counts as inaccurate if (receiver error) * sqrt(receiver area
// / reference area) exceeds eps, the largest allowed link error, or if (source error) * sqrt(receiver area /
// reference area) exceeds a fraction of eps. Because of the factor sqrt(receiver area / reference area), the
// sum of the squared link errors is proportional to the squared error integrated over the scene. Because
// errors are multiplied by sqrt(receiver area / reference area), refinement ends even along edges where walls
// meet, where form factors vary at every scale.

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// An AreaWeightedOracle splits that end of a link, receiver or source, that causes the larger transport
// error. Derived classes define deviation(F), the deviation of the form factor over the receiver.
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
