// solver/transport/links/oracle.h
//
// Refinement oracles: which links carry too much error, and which end of them to split (thesis 4.4).

#pragma once

#include <cstdint>
#include <memory>

#include "solver/transport/links/solution.h"

namespace penumbra {

enum class Refinement : std::uint8_t { kAccept, kSplitReceiver, kSplitSource };

// Judges links. Further oracles are further classes.
class RefinementOracle {
 public:
  virtual ~RefinementOracle() = default;
  // What to do about the link, given the radiosities of the solution so far. Safe from several threads.
  virtual Refinement Judge(const RadiositySolution& solution, const Link& link) const = 0;
};

// Those that there are. All but the last estimate the transport error of a link (thesis 4.4.1), in W/m^2 of
// irradiance, for the largest channel. Our point form factors are exact whatever the size of the source, so
// that a link errs in two ways only: the receiver's irradiance varies over it, B x deviation(F), and the
// source's radiosity varies within its quarters, F x spread(B) x variation(F). Both count by the square root
// of the receiver's area, so that the squares add up to the error over the scene, and the elements along
// edges where walls meet, whose form factors vary whatever their size, are not split for ever. An element of
// reference area errs by at most eps.
enum class OracleKind : std::uint8_t {
  kTransport,   // the deviation among the points at which the link was sampled
  kVisibility,  // the same, but a partial link's counts twice: shadows may fall between those points
  kGradient,  // that of the linear function with the form factor's gradient at the receiver's centre, without
              // occlusion; of partial links the sampled one if it is larger
  kThesis,    // as printed: B x deviation(F) against eps, whatever the area; the larger element is split
};

struct OracleOptions {
  double eps = 0.1;           // [W/m^2]
  double min_area = 1e-5;     // [m^2]: no element smaller than four times this is split
  double reference_area = 1;  // [m^2]
};

std::unique_ptr<const RefinementOracle> MakeOracle(OracleKind kind, const OracleOptions& options);

}  // namespace penumbra
