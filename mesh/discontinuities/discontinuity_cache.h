// mesh/discontinuities/discontinuity_cache.h
//
// A cache of discontinuities that stores the factors of a weight separately (thesis 5.4). Traces and their
// geometric factors are computed once; the radiometric factor is the source's current radiosity.

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

  // The result of DiscontinuityFinder::Find(), byte for byte. The cache traces a source when its strength
  // first reaches the minimum. The cache traces the source again only if options other than the strengths
  // change, or if the source has become so bright that lighter discontinuities reach the minimum weight. Safe
  // from several threads for different receivers. If the context is cancelled, the result is incomplete; the
  // cache keeps what it traced completely.
  std::vector<Discontinuity> Find(PatchId receiver, std::span<const double> source_strength,
                                  const DiscontinuityOptions& options,
                                  const ExecutionContext& context = ExecutionContext());

  // Pairs of receiver and source since construction: how many were traced, and how many the cache answered.
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
