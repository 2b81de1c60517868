#include "mesh/discontinuities/discontinuity_cache.h"

#include <cmath>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// Traces include discontinuities down to this fraction of the minimum weight, so that a source may become
// brighter without new traces: a choice.
constexpr double kHeadroom = 0.5;

// True if discontinuities found with `a` are valid for `b`, apart from strengths and the minimum weight.
bool SameGeometry(const DiscontinuityOptions& a, const DiscontinuityOptions& b) {
  return a.weight == b.weight && a.keep_hidden == b.keep_hidden &&
         a.triple_edge_tolerance == b.triple_edge_tolerance;
}

}  // namespace

DiscontinuityCache::DiscontinuityCache(const Scene& scene, const PatchVisibility& visibility)
    : scene_(scene), visibility_(visibility), finder_(scene, visibility), receivers_(scene.patches.size()) {}

std::vector<Discontinuity> DiscontinuityCache::Find(PatchId receiver, std::span<const double> source_strength,
                                                    const DiscontinuityOptions& options,
                                                    const ExecutionContext& context) {
  PENUMBRA_CHECK(source_strength.size() == receivers_.size());
  Receiver& known = receivers_[receiver];
  const std::span<const PatchPair> pairs = visibility_.SourcesOf(receiver);
  if (!known.known || !SameGeometry(known.options, options)) {
    known.known = true;
    known.options = options;
    known.contacts = finder_.FindContacts(receiver, options);
    known.sources.assign(pairs.size(), {});
  }
  const double size = std::sqrt(scene_.patches[receiver].area);
  std::vector<Discontinuity> found = known.contacts;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double strength = source_strength[pairs[i].source];
    if (!DiscontinuityFinder::Counts(strength, options)) continue;
    Source& source = known.sources[i];
    const double least = options.min_weight / strength;
    if (!source.traced || least < source.least) {
      DiscontinuityOptions unit = options;
      unit.min_weight = kHeadroom * least;
      std::vector<Discontinuity> edges = finder_.FindFrom(receiver, pairs[i], 1, unit, context);
      if (context.Cancelled()) return found;
      source.traced = true;
      source.least = unit.min_weight;
      source.edges = std::move(edges);
      ++known.counts.traced;
    } else {
      ++known.counts.kept;
    }
    for (Discontinuity d : source.edges) {
      d.strength = strength;
      d.weight = Weight(d, options.weight, size);
      if (d.weight >= options.min_weight) found.push_back(d);
    }
  }
  return found;
}

DiscontinuityCache::Counts DiscontinuityCache::counts() const {
  Counts sum;
  for (const Receiver& receiver : receivers_) {
    sum.traced += receiver.counts.traced;
    sum.kept += receiver.counts.kept;
  }
  return sum;
}

}  // namespace penumbra
