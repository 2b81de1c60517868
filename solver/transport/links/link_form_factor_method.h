// solver/transport/links/link_form_factor_method.h
//
// How the form factors of links are found: several methods behind one interface.

#pragma once

#include <cstddef>
#include <vector>

#include "solver/base/progress.h"
#include "solver/base/registry.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// What is known of a link before its form factor is.
struct LinkView {
  // Those of the link's blockers that suffice to tell which segments between its ends are blocked.
  std::vector<PatchId> blockers;
  Polygon3 lit;             // the receiver's part before the source's plane [m]; empty if that is all of it
  double lit_fraction = 1;  // of the receiver's area
};

// The links of one receiver, and the view of each.
struct ReceiverLinks {
  const ElementForest& forest;
  ElementId receiver = kNoElement;
  LinkSet set;
  std::vector<LinkView> views;  // as many as links
};

class LinkFormFactorMethod {
 public:
  virtual ~LinkFormFactorMethod() = default;

  // Sets form_factor, variation, share and source_variation of all links. Before, they are those of a link
  // that carries no light. The part of the receiver behind the source's plane counts as dark. Safe from
  // several threads. Sets nothing of use if it was cancelled.
  virtual void Find(ReceiverLinks* links, const ExecutionContext& context) const = 0;
};

struct LinkFormFactorOptions {
  // Exact form factors: the error that a factor may have where something stands between [1], and the number
  // of points that it may cost.
  double tolerance = 1e-7;
  std::size_t max_points = 100'000;
};

// LinkFormFactorMethods() holds all methods.
using LinkFormFactorRegistry = Registry<const LinkFormFactorMethod, LinkFormFactorOptions>;

}  // namespace penumbra
