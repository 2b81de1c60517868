#include "mesh/interpolants/row_sampler.h"

#include <cstddef>

#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

constexpr std::size_t kRowsATask = 16, kProductsATask = 256;

}  // namespace

RowSampler::RowSampler(const PointIrradiance& exact, double tolerance, SampleCache* rows, bool keep)
    : exact_(exact), tolerance_(tolerance), rows_(rows), keep_(keep) {
  PENUMBRA_CHECK(exact.CanRecord() && (rows || !keep));
}

std::vector<PointIrradianceResult> RowSampler::At(std::span<const PatchPoint> points) const {
  std::vector<PointIrradianceResult> results(points.size());
  std::vector<char> is_new(points.size(), 0);
  ParallelFor(points.size(), kRowsATask, [&](std::size_t i) {
    const auto& [patch, at] = points[i];
    const PointIrradianceResult* known = rows_ ? rows_->Find(patch, at) : nullptr;
    if (known && known->row) {
      results[i] = *known;
      return;
    }
    results[i] = exact_.RecordOnPatch(patch, at, tolerance_);
    is_new[i] = known ? 0 : 1;
  });
  for (std::size_t i = 0; keep_ && i < points.size(); ++i)
    if (is_new[i]) rows_->Insert(points[i].patch, points[i].at, results[i]);
  return results;
}

IrradianceSampler RowSampler::For(const SourceSet& light) const {
  const auto many = [this, &light](std::span<const PatchPoint> points,
                                   std::span<PointIrradianceResult> results) {
    const std::vector<PointIrradianceResult> rows = At(points);
    ParallelFor(points.size(), kProductsATask, [&](std::size_t i) {
      results[i] = {Irradiance(*rows[i].row, light), rows[i].one_sided};
    });
  };
  return IrradianceSampler::OfMany(many);
}

}  // namespace penumbra
