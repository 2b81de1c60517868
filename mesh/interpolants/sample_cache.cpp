#include "mesh/interpolants/sample_cache.h"

#include <bit>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/base/parallel.h"

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
  return found == samples_.end() ? nullptr : &found->second.result;
}

void SampleCache::Insert(PatchId patch, const ReceiverPoint& at, const PointIrradianceResult& sample) {
  samples_.emplace(Key{patch, at.position, sample.one_sided ? at.approach : Vec3::Zero()},
                   Sample{at, sample});
}

namespace {

// The patches that send light only now.
std::vector<PatchId> NewSources(const SourceSet& before, const SourceSet& now) {
  std::vector<PatchId> sources;
  for (std::size_t p = 0; p < now.PatchCount(); ++p) {
    const auto patch = static_cast<PatchId>(p);
    if (before.Tree(patch).empty() && !now.Tree(patch).empty()) sources.push_back(patch);
  }
  return sources;
}

}  // namespace

std::size_t SampleCache::Relight(const SourceSet& before, const PointIrradiance& now, double tolerance,
                                 const ExecutionContext& context) {
  constexpr std::size_t kSamplesATask = 64;
  const std::vector<std::int32_t> map = MapNodes(before, now.sources());
  const std::vector<PatchId> new_sources = NewSources(before, now.sources());
  std::vector<std::pair<PatchId, Sample*>> samples;
  samples.reserve(samples_.size());
  for (auto& [key, sample] : samples_) samples.emplace_back(key.patch, &sample);
  std::vector<std::size_t> gathered(samples.size(), 0);
  ParallelFor(samples.size(), kSamplesATask, [&](std::size_t i) {
    if (context.Cancelled()) return;
    const auto [patch, sample] = samples[i];
    PointIrradianceResult& result = sample->result;
    if (!result.row || !now.CanRecord()) {
      result = now.RecordOnPatch(patch, sample->at, tolerance);
      gathered[i] = result.row ? result.row->sources.size() : 1;
      return;
    }
    for (FactorTerm& term : result.row->terms)
      if (term.node >= 0) term.node = map[static_cast<std::size_t>(term.node)];
    gathered[i] = now.Renew(patch, sample->at, tolerance, new_sources, *result.row);
    result.irradiance = Irradiance(*result.row, now.sources());
  });
  if (context.Cancelled()) Clear();
  return std::accumulate(gathered.begin(), gathered.end(), std::size_t{0});
}

void SampleCache::Clear() { samples_.clear(); }

}  // namespace penumbra
