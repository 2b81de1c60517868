// mesh/interpolants/sample_cache.h
//
// A cache of irradiance samples that remain valid from one mesh to the next. Most sample points keep their
// positions when quadtree leaves are divided or discontinuity lines are added. The key of a sample consists
// of the patch and the exact position of the sample. If a sample is a one-sided limit, its key also contains
// the approach direction, which identifies the side of a contact on which the sample lies.
//
// A sample that has its form factors (FactorRow) also remains valid when the light changes: its new
// irradiance is the product of form factors and radiosities.

#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "solver/base/progress.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

class SampleCache {
 public:
  // Returns the sample at the given point, or null if the cache does not contain the sample.
  const PointIrradianceResult* Find(PatchId patch, const ReceiverPoint& at) const;
  void Insert(PatchId patch, const ReceiverPoint& at, const PointIrradianceResult& sample);
  // Gives all samples the irradiance from other radiosities of the sources, after the light has changed.
  // `before` is the set of sources to which the cached form factors belong, and `now` is the irradiance from
  // the changed sources. Form factors whose errors are larger than `tolerance` permits for the new light are
  // computed again (PointIrradiance::Renew), and so are samples without form factors. Returns the number of
  // pairs (source, sample point) for which the light of the source at the point was gathered again. If the
  // computation is cancelled, all samples are removed.
  std::size_t Relight(const SourceSet& before, const PointIrradiance& now, double tolerance,
                      const ExecutionContext& context);
  // Removes all samples from the cache.
  void Clear();
  // Adds those samples of another cache whose points are not yet in this cache.
  void Merge(SampleCache&& other) { samples_.merge(other.samples_); }
  std::size_t size() const { return samples_.size(); }

 private:
  struct Key {
    PatchId patch = kNoPatch;
    // The position of the sample, and the direction of its one-sided limit; zero if it has none.
    Vec3 position, approach;
    bool operator==(const Key& other) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  struct Sample {
    ReceiverPoint at;
    PointIrradianceResult result;
  };
  std::unordered_map<Key, Sample, Hash> samples_;
};

}  // namespace penumbra
