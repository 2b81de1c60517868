// solver/transport/links/link_form_factor_method.h
//
// The interface of methods that compute the form factors of links.

#pragma once

#include <cstddef>
#include <vector>

#include "solver/base/progress.h"
#include "solver/base/registry.h"
#include "solver/transport/links/solution.h"

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
};

struct LinkFormFactorOptions {
  // For the exact method: the allowed error of a form factor with blockers [1], and the largest number of
  // points for one form factor.
  double tolerance = 1e-7;
  std::size_t max_points = 100'000;
};

// LinkFormFactorMethods() lists all methods.
using LinkFormFactorRegistry = Registry<const LinkFormFactorMethod, LinkFormFactorOptions>;

}  // namespace penumbra
