// solver/transport/links/area_weighted_oracle.h
//
// Oracles that estimate the transport error of a link (thesis 4.4.1), in W/m^2 of irradiance, for the largest
// channel. Because point form factors are exact for sources of any size, a link has only two errors. The
// receiver error B * deviation(F) arises because the irradiance varies over the receiver. The source error F
// * spread(B) * variation(F) arises because the radiosity varies within the source's quarters. The oracle
// multiplies both the receiver error and the source error by sqrt(receiver area / reference area), and
// compares the products with eps. The factor sqrt(receiver area / reference area) has two effects: the sum of
// the squared link errors equals the squared error over the scene; and refinement ends even along edges where
// walls meet, where form factors vary at every scale.

#pragma once

#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

// Splits the end of the link, receiver or source, that causes the larger error. Derived classes define
// deviation(F), the deviation of the form factor over the receiver.
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
