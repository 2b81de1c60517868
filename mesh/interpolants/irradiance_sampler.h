// mesh/interpolants/irradiance_sampler.h
//
// A function that gives the irradiance at points of patches to the builder of a mesh. The irradiance of a
// sampler comes from PointIrradiance, or from any function that replaces PointIrradiance.

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
  // Several threads call the sampling function at once.
  template <std::invocable<PatchId, const ReceiverPoint&> Function>
  IrradianceSampler(Function one) : one_(std::move(one)) {}  // NOLINT: implicit conversion is intended
  // The function `many` evaluates the irradiance at many points in parallel. At the same point, the values of
  // `many` and of `one` differ by no more than their errors.
  IrradianceSampler(One one, Many many) : one_(std::move(one)), many_(std::move(many)) {}

  // Returns a sampler that calls `many` for a single point with a list of one point.
  static IrradianceSampler OfMany(Many many);

  PointIrradianceResult operator()(PatchId patch, const ReceiverPoint& at) const { return one_(patch, at); }
  // Sets results[i] to the irradiance at points[i] for all i, in parallel. REQUIRES: `points` and `results`
  // have the same size.
  void SampleAll(std::span<const PatchPoint> points, std::span<PointIrradianceResult> results) const;

  bool empty() const { return one_ == nullptr; }

 private:
  One one_;
  Many many_;  // function for many points; if empty, one_ is called for each point
};

// Returns a sampler that calls exact.NearlyOnPatch() with the given tolerance. `exact` must outlive the
// sampler.
IrradianceSampler NearSampler(const PointIrradiance& exact, double tolerance);
// Returns a sampler that calls exact.RecordOnPatch() with the given tolerance. Each sample of a
// RecordingSampler() contains its form factors (FactorRow), unless rays give the irradiance
// (PointIrradiance::IsSampled). `exact` must outlive the sampler.
IrradianceSampler RecordingSampler(const PointIrradiance& exact, double tolerance);
// Returns a sampler that calls `sampler`, but gives irradiance 0 after the computation has been cancelled.
// `context` must outlive the returned sampler.
IrradianceSampler WhileGoing(IrradianceSampler sampler, const ExecutionContext& context);

}  // namespace penumbra
