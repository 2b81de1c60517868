#include "mesh/interpolants/row_sampler.h"

#include <cstddef>

#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/processes.h"
#include "solver/transport/points/sample_bytes.h"

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
  std::vector<std::size_t> without_row, is_new;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointIrradianceResult* known = rows_ ? rows_->Find(points[i].patch, points[i].at) : nullptr;
    if (known && known->row)
      results[i] = *known;
    else
      without_row.push_back(i);
    if (!known) is_new.push_back(i);
  }
  const auto compute = [&](std::size_t k) {
    const PatchPoint& point = points[without_row[k]];
    results[without_row[k]] = exact_.RecordOnPatch(point.patch, point.at, tolerance_);
  };
  const auto transfer = [&](std::size_t k, auto& archive) { Transfer(archive, results[without_row[k]]); };
  DealOut({without_row.size(), kRowsATask, compute, transfer, transfer});
  if (keep_)
    for (const std::size_t i : is_new) rows_->Insert(points[i].patch, points[i].at, results[i]);
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
