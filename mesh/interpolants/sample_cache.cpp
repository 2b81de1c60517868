#include "mesh/interpolants/sample_cache.h"

#include <bit>

namespace penumbra {

std::size_t SampleCache::Hash::operator()(const Key& key) const {
  std::uint64_t h = static_cast<std::uint32_t>(key.patch);
  for (const Vec3* v : {&key.position, &key.approach})
    for (int i = 0; i < 3; ++i) {
      // Adding 0 gives both zeros the same bits.
      h ^= std::bit_cast<std::uint64_t>((*v)[i] + 0.0);
      h *= 0x9E3779B97F4A7C15ULL;
      h ^= h >> 29;
    }
  return h;
}

const PointIrradianceResult* SampleCache::Find(PatchId patch, const ReceiverPoint& at) const {
  auto found = samples_.find({patch, at.position, Vec3::Zero()});
  if (found == samples_.end()) found = samples_.find({patch, at.position, at.approach});
  return found == samples_.end() ? nullptr : &found->second;
}

void SampleCache::Insert(PatchId patch, const ReceiverPoint& at, const PointIrradianceResult& sample) {
  samples_.emplace(Key{patch, at.position, sample.one_sided ? at.approach : Vec3::Zero()}, sample);
}

void SampleCache::Clear() { samples_.clear(); }

}  // namespace penumbra
