// mesh/interpolants/sample_cache.h
//
// Irradiance samples that outlive a mesh: when leaves are divided, or lines added, most nodes stay where they
// are. A sample is known by its patch and position, to the bit; where the side matters also by the direction
// of approach, which names the sheet that it belongs to.

#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

class SampleCache {
 public:
  // The sample of that node; null if it is not known.
  const PointIrradianceResult* Find(PatchId patch, const ReceiverPoint& at) const;
  void Insert(PatchId patch, const ReceiverPoint& at, const PointIrradianceResult& sample);
  // Forgets all: the sources have changed.
  void Clear();
  std::size_t size() const { return samples_.size(); }

 private:
  struct Key {
    PatchId patch = kNoPatch;
    Vec3 position, approach;  // approach is zero for what does not depend on it
    bool operator==(const Key& other) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  std::unordered_map<Key, PointIrradianceResult, Hash> samples_;
};

}  // namespace penumbra
