#include "mesh/interpolants/irradiance_sampler.h"

#include <algorithm>

#include "solver/base/check.h"
#include "solver/base/processes.h"
#include "solver/transport/points/sample_bytes.h"

namespace penumbra {

void IrradianceSampler::SampleAll(std::span<const PatchPoint> points,
                                  std::span<PointIrradianceResult> results) const {
  PENUMBRA_CHECK(points.size() == results.size());
  if (many_) {
    many_(points, results);
    return;
  }
  constexpr std::size_t kPointsATask = 16;
  DealOut(results, kPointsATask, [&](std::size_t i) { results[i] = one_(points[i].patch, points[i].at); });
}

IrradianceSampler IrradianceSampler::OfMany(Many many) {
  const auto one = [many](PatchId patch, const ReceiverPoint& at) {
    const PatchPoint point{patch, at};
    PointIrradianceResult result;
    many({&point, 1}, {&result, 1});
    return result;
  };
  return {one, std::move(many)};
}

IrradianceSampler NearSampler(const PointIrradiance& exact, double tolerance) {
  const auto one = [&exact, tolerance](PatchId patch, const ReceiverPoint& at) {
    return exact.NearlyOnPatch(patch, at, tolerance);
  };
  if (!exact.IsSampled()) return one;
  return {one, [&exact](std::span<const PatchPoint> points, std::span<PointIrradianceResult> results) {
            exact.SampleTogether(points, results);
          }};
}

IrradianceSampler RecordingSampler(const PointIrradiance& exact, double tolerance) {
  if (exact.IsSampled()) return NearSampler(exact, tolerance);
  return [&exact, tolerance](PatchId patch, const ReceiverPoint& at) {
    return exact.RecordOnPatch(patch, at, tolerance);
  };
}

IrradianceSampler WhileGoing(IrradianceSampler sampler, const ExecutionContext& context) {
  const auto one = [sampler, &context](PatchId patch, const ReceiverPoint& at) {
    return context.Cancelled() ? PointIrradianceResult() : sampler(patch, at);
  };
  // A few points at a time, so that a cancelled run ends soon.
  static constexpr std::size_t kMost = 4096;
  return {one, [sampler = std::move(sampler), &context](std::span<const PatchPoint> points,
                                                        std::span<PointIrradianceResult> results) {
            for (std::size_t begin = 0; begin < points.size() && !context.Cancelled(); begin += kMost) {
              const std::size_t size = std::min(kMost, points.size() - begin);
              sampler.SampleAll(points.subspan(begin, size), results.subspan(begin, size));
            }
          }};
}

}  // namespace penumbra
