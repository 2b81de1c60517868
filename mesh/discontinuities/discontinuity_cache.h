// mesh/discontinuities/discontinuity_cache.h
//
// A cache of discontinuities (thesis 5.4). The weight of a discontinuity is the product of a geometric
// factor, which the cache computes once together with the trace, and the source's current radiosity.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "solver/base/progress.h"

namespace penumbra {

class DiscontinuityCache {
 public:
  // Scene and visibility must outlive the cache.
  DiscontinuityCache(const Scene& scene, const PatchVisibility& visibility);

  // Returns exactly the result of DiscontinuityFinder::Find(). The discontinuities of a source are traced
  // when its strength first reaches the minimum. The discontinuities of a source are traced again only if
  // options other than the strengths change, or if the source has become so bright that further
  // discontinuities reach the minimum weight. Several threads may call the function at once for different
  // receivers. If the context is cancelled, the result is incomplete; the cache keeps the sources that were
  // traced completely.
  std::vector<Discontinuity> Find(PatchId receiver, std::span<const double> source_strength,
                                  const DiscontinuityOptions& options,
                                  const ExecutionContext& context = ExecutionContext());

  // The number of pairs of receiver and source that were traced since construction, and the number of pairs
  // for which the cache already had the discontinuities.
  struct Counts {
    std::size_t traced = 0, kept = 0;
  };
  Counts counts() const;

 private:
  struct Source {
    bool traced = false;
    double least = 0;  // smallest known weight for a source of 1 W/m^2
    std::vector<Discontinuity> edges;
  };
  struct Receiver {
    bool known = false;
    DiscontinuityOptions options;  // all entries were found with these options
    std::vector<Discontinuity> contacts;
    std::vector<Source> sources;  // in the order of PatchVisibility::SourcesOf()
    Counts counts;
  };

  const Scene& scene_;
  const PatchVisibility& visibility_;
  DiscontinuityFinder finder_;
  std::vector<Receiver> receivers_;
};

}  // namespace penumbra
