// mesh/discontinuities/discontinuity_cache.h
//
// A cache of discontinuities (thesis 5.4). The weight of a discontinuity is the product of a geometric factor
// and the source's current radiosity. The DiscontinuityCache computes the geometric factor of each
// discontinuity only once.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "solver/base/progress.h"

namespace penumbra {

class DiscontinuityCache {
 public:
  // Scene and visibility must outlive the DiscontinuityCache.
  DiscontinuityCache(const Scene& scene, const PatchVisibility& visibility);

  // DiscontinuityCache::Find() returns exactly the result of DiscontinuityFinder::Find(). The discontinuities
  // of a source are computed when the source's largest radiosity first reaches the minimum weight of a
  // discontinuity. The discontinuities of a source are computed again only if the DiscontinuityOptions
  // change, or if the source has become so bright that further discontinuities reach the minimum weight.
  // Several threads may call Find() at once for different receivers. If the computation is cancelled, the
  // result is incomplete, and the cache keeps the discontinuities of those sources that were completed.
  std::vector<Discontinuity> Find(PatchId receiver, std::span<const double> source_strength,
                                  const DiscontinuityOptions& options,
                                  const ExecutionContext& context = ExecutionContext());

  // `traced` counts the pairs of receiver and source whose discontinuities were computed since construction.
  // `kept` counts the pairs of receiver and source whose discontinuities Find() took from the cache.
  struct Counts {
    std::size_t traced = 0, kept = 0;
  };
  Counts counts() const;

 private:
  struct Source {
    bool traced = false;
    // `edges` holds all discontinuities whose weight is at least `least` for a source of 1 W/m^2.
    double least = 0;
    std::vector<Discontinuity> edges;
  };
  struct Receiver {
    bool known = false;
    DiscontinuityOptions options;  // options with which the discontinuities of this receiver were found
    std::vector<Discontinuity> contacts;
    std::vector<Source> sources;  // sources of the receiver, in the order of PatchVisibility::SourcesOf()
    Counts counts;
  };

  const Scene& scene_;
  const PatchVisibility& visibility_;
  DiscontinuityFinder finder_;
  std::vector<Receiver> receivers_;
};

}  // namespace penumbra
