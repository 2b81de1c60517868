// mesh/interpolants/sample_cache.h
//
// A cache of irradiance samples that remain valid from one mesh to the next: most nodes keep their positions
// when leaves are divided or lines are added. The key of a sample is its patch and its exact position. The
// key of a one-sided sample also contains the approach direction, which identifies the sample's sheet, the
// side of the contact on which the sample lies.

#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

class SampleCache {
 public:
  // The sample at this node; null if it is unknown.
  const PointIrradianceResult* Find(PatchId patch, const ReceiverPoint& at) const;
  void Insert(PatchId patch, const ReceiverPoint& at, const PointIrradianceResult& sample);
  // Removes all samples. Must be called after the sources have changed.
  void Clear();
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
  std::unordered_map<Key, PointIrradianceResult, Hash> samples_;
};

}  // namespace penumbra
