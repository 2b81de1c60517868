// solver/transport/links/link_form_factor_method.h
//
// The interface of methods that compute the form factors of links (interactions between two elements).

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/base/registry.h"
#include "solver/transport/links/solution.h"
#include "solver/visibility/area/area_form_factor.h"
#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// The data from which the form factor of a link is computed.
struct LinkView {
  // A subset of the link's blockers that contains, for every blocked segment between the ends of the link, at
  // least one patch that blocks the segment.
  std::vector<PatchId> blockers;
  // The part of the receiver in front of the source's plane [m]; empty if the whole receiver lies there.
  Polygon3 lit;
  // (area of the receiver's part in front of the source's plane) / (area of the receiver)
  double lit_fraction = 1;
};

// All links of one receiver, with a LinkView (blockers, and the receiver's part in front of the source's
// plane) for each link.
struct ReceiverLinks {
  const ElementForest& forest;
  ElementId receiver = kNoElement;
  LinkSet set;
  std::vector<LinkView> views;  // one LinkView for each link in `set`
};

class LinkFormFactorMethod {
 public:
  virtual ~LinkFormFactorMethod() = default;

  // Sets the members form_factor, variation, share and source_variation of all links. Before the call of
  // Find(), form_factor, variation, share and source_variation have the initial values of a link without
  // light transport. The part of the receiver behind the source's plane counts as unlit. Several threads may
  // call Find() at once. If the computation is cancelled (ExecutionContext), the links' values must not be
  // used.
  virtual void Find(ReceiverLinks* links, const ExecutionContext& context) const = 0;

  // The form factor sum A_i F_ij / sum A_i of all parts i in `from` to all parts j in `to`; any patch of the
  // scene may block light. Each form-factor method documents what its error estimate means. Between() returns
  // nullopt if the method computes form factors of links only. If the computation is cancelled
  // (ExecutionContext), the form factor must not be used.
  virtual std::optional<FormFactorEstimate> Between(const Scene& /*scene*/,
                                                    std::span<const AreaPart> /*from*/,
                                                    std::span<const AreaPart> /*to*/,
                                                    const ExecutionContext& /*context*/) const {
    return std::nullopt;
  }

  // True if Find() computes the form factors of all links of the receiver in one view from the receiver, as a
  // hemicube does. If SeesAllAtOnce() is true, and one patch shoots light to many receivers, one view from
  // the shooting patch costs less than a view from each receiver.
  virtual bool SeesAllAtOnce() const { return false; }
};

// The upper bound of LinkFormFactorOptions::resolution. With a resolution of 4096, the planes of one hemicube
// or similar view take some 600 MB.
inline constexpr std::uint64_t kMostResolution = 4096;

struct LinkFormFactorOptions {
  // Options of the method `exact`: `tolerance` is the allowed error of a form factor with blockers [1], and
  // `max_points` the largest number of points for one form factor.
  double tolerance = 1e-7;
  std::size_t max_points = 100'000;
  // The number of cells along a side of the projection planes, for hemicubes and similar methods; 0 selects
  // the default of the method.
  std::size_t resolution = 0;
  // The number of rays for one form factor, in methods that cast rays; 0 selects the default of the method.
  std::size_t rays = 0;
  std::uint64_t seed = 1;  // seed of the random rotations of hemicubes and similar planes, and of random rays
  // If true, Find() needs to compute only Link::form_factor, not Link::variation and Link::share.
  bool factors_only = false;
  // The occlusion method of the methods `cubature`, `exact` and `disk`; null for the fastest exact method.
  std::shared_ptr<const OcclusionMethod> occlusion = {};
};

// The type of the registry LinkFormFactorMethods(), which lists all form-factor methods.
using LinkFormFactorRegistry = Registry<const LinkFormFactorMethod, LinkFormFactorOptions>;

}  // namespace penumbra
