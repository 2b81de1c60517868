// mesh/interpolants/sample_cache.h
//
// A cache of irradiance samples that remain valid from one mesh to the next: most nodes keep their positions
// when leaves are divided or lines are added. The key of a sample is its patch and its exact position. The
// key of a one-sided sample also contains the approach direction, which identifies the sample's sheet, the
// side of the contact on which the sample lies.
//
// A sample that has a row of form factors (FactorRow) also remains valid when the light changes: its new
// irradiance is a product.

#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "solver/base/progress.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

class SampleCache {
 public:
  // The sample at this node; null if it is unknown.
  const PointIrradianceResult* Find(PatchId patch, const ReceiverPoint& at) const;
  void Insert(PatchId patch, const ReceiverPoint& at, const PointIrradianceResult& sample);
  // Gives all samples the values for other sources: for use after the light has changed. `before` is the set
  // of sources that belongs to the rows, `now` the irradiance from the new sources. Parts of rows that do not
  // hold for the new light to the tolerance are gathered anew (PointIrradiance::Renew), and so are samples
  // without rows. Returns the number of sources of points that were gathered. If cancelled, removes all
  // samples.
  std::size_t Relight(const SourceSet& before, const PointIrradiance& now, double tolerance,
                      const ExecutionContext& context);
  // Removes all samples.
  void Clear();
  // Adds the samples of another cache, as far as their nodes are unknown.
  void Merge(SampleCache&& other) { samples_.merge(other.samples_); }
  std::size_t size() const { return samples_.size(); }

 private:
  struct Key {
    PatchId patch = kNoPatch;
    Vec3 position, approach;  // approach is zero for samples that do not depend on it
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
