// solver/transport/links/link_form_factor_method.h
//
// The interface of methods that compute the form factors of links.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/base/registry.h"
#include "solver/transport/links/solution.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {

// The data from which the form factor of a link is computed.
struct LinkView {
  // A subset of the link's blockers that contains, for every blocked segment between the ends of the link, at
  // least one patch that blocks the segment.
  std::vector<PatchId> blockers;
  Polygon3 lit;             // the receiver's part before the source's plane [m]; empty: all of the receiver
  double lit_fraction = 1;  // area of that part / area of the receiver
};

// The links of one receiver, with a LinkView for each link.
struct ReceiverLinks {
  const ElementForest& forest;
  ElementId receiver = kNoElement;
  LinkSet set;
  std::vector<LinkView> views;  // one for each link
};

class LinkFormFactorMethod {
 public:
  virtual ~LinkFormFactorMethod() = default;

  // Sets form_factor, variation, share and source_variation of all links. On entry, the four members have the
  // values for a link that transports no light. The part of the receiver behind the source's plane counts as
  // dark. May be called from several threads. The values are useless if the context is cancelled.
  virtual void Find(ReceiverLinks* links, const ExecutionContext& context) const = 0;

  // The form factor of several parts together to several others, past all patches of the scene: sum A_i F_ij
  // / sum A_i. The method says what its error means. nullopt if the method knows links only. The value is
  // useless if the context is cancelled.
  virtual std::optional<FormFactorEstimate> Between(const Scene& /*scene*/,
                                                    std::span<const AreaPart> /*from*/,
                                                    std::span<const AreaPart> /*to*/,
                                                    const ExecutionContext& /*context*/) const {
    return std::nullopt;
  }

  // True if Find() looks once from the receiver and finds the form factors of all its links together. Such
  // methods cost less from one element that sends to many than from the many that receive.
  virtual bool SeesAllAtOnce() const { return false; }
};

// The upper bound of LinkFormFactorOptions::resolution: the planes of one view then take some 600 MB.
inline constexpr std::uint64_t kMostResolution = 4096;

struct LinkFormFactorOptions {
  // For the exact method: the allowed error of a form factor with blockers [1], and the largest number of
  // points for one form factor.
  double tolerance = 1e-7;
  std::size_t max_points = 100'000;
  std::size_t resolution =
      0;                   // cells along a side of the planes of hemicubes and their like; 0: the method's
  std::size_t rays = 0;    // rays for one form factor, where methods cast rays; 0: as many as the method
                           // takes for links
  std::uint64_t seed = 1;  // of random turns and rays
  // If true, only the form factors of links are needed: variations and shares may stay as they are.
  bool factors_only = false;
};

// LinkFormFactorMethods() lists all methods.
using LinkFormFactorRegistry = Registry<const LinkFormFactorMethod, LinkFormFactorOptions>;

}  // namespace penumbra
