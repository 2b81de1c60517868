// mesh/discontinuities/discontinuity_cache.h
//
// What a weight is made of, kept apart (thesis 5.4): the geometric factor, with the trace that it belongs to,
// is found once; the radiometric factor, the source's radiosity, is that of the day.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "solver/base/progress.h"

namespace penumbra {

class DiscontinuityCache {
 public:
  // Both must outlive the cache.
  DiscontinuityCache(const Scene& scene, const PatchVisibility& visibility);

  // What DiscontinuityFinder::Find() gives, to the byte. A source is traced the first time that it is strong
  // enough to count, and again only when it has become so much brighter that weaker edges of its come to
  // count, or other options than the strengths are asked for. Safe from several threads for different
  // receivers. Of no use if it was cancelled; what was found whole is kept.
  std::vector<Discontinuity> Find(PatchId receiver, std::span<const double> source_strength,
                                  const DiscontinuityOptions& options,
                                  const ExecutionContext& context = ExecutionContext());

  // Pairs of receiver and source since the beginning: how often one was traced, and how often what was known
  // was enough.
  struct Counts {
    std::size_t traced = 0, kept = 0;
  };
  Counts counts() const;

 private:
  struct Source {
    bool traced = false;
    double least = 0;  // of the weight for a source of 1 W/m^2: lighter edges are not known
    std::vector<Discontinuity> edges;
  };
  struct Receiver {
    bool known = false;
    DiscontinuityOptions options;  // that all was found with
    std::vector<Discontinuity> contacts;
    std::vector<Source> sources;  // as in PatchVisibility::SourcesOf()
    Counts counts;
  };

  const Scene& scene_;
  const PatchVisibility& visibility_;
  DiscontinuityFinder finder_;
  std::vector<Receiver> receivers_;
};

}  // namespace penumbra
