// mesh/interpolants/irradiance_sampler.h
//
// The irradiance at points of patches, as the nodes of a mesh need it: from PointIrradiance, or from any
// function that replaces it.

#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <utility>

#include "solver/base/progress.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

class IrradianceSampler {
 public:
  using One = std::function<PointIrradianceResult(PatchId, const ReceiverPoint&)>;
  using Many = std::function<void(std::span<const PatchPoint>, std::span<PointIrradianceResult>)>;

  IrradianceSampler() = default;
  // Several threads call the function at once.
  template <std::invocable<PatchId, const ReceiverPoint&> Function>
  IrradianceSampler(Function one) : one_(std::move(one)) {}  // NOLINT: a function is a sampler
  // `many` evaluates many points in parallel. Its values agree with those of `one` within the error of both.
  IrradianceSampler(One one, Many many) : one_(std::move(one)), many_(std::move(many)) {}

  // A sampler that takes one point for a list of one.
  static IrradianceSampler OfMany(Many many);

  PointIrradianceResult operator()(PatchId patch, const ReceiverPoint& at) const { return one_(patch, at); }
  // Sets results[i] to the irradiance at points[i], in parallel. REQUIRES: the sizes are equal.
  void SampleAll(std::span<const PatchPoint> points, std::span<PointIrradianceResult> results) const;

  bool empty() const { return one_ == nullptr; }

 private:
  One one_;
  Many many_;  // empty: one_ for each point
};

// A sampler that calls exact.NearlyOnPatch() with the given tolerance. `exact` must outlive the sampler.
IrradianceSampler NearSampler(const PointIrradiance& exact, double tolerance);
// A sampler that calls exact.RecordOnPatch() with the given tolerance. Each sample then contains its form
// factors (FactorRow), unless rays give the irradiance (PointIrradiance::IsSampled). `exact` must outlive the
// sampler.
IrradianceSampler RecordingSampler(const PointIrradiance& exact, double tolerance);
// A sampler that calls `sampler`, but returns irradiance 0 after the context is cancelled. `context` must
// outlive the returned function.
IrradianceSampler WhileGoing(IrradianceSampler sampler, const ExecutionContext& context);

}  // namespace penumbra
