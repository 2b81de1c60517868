// solver/transport/form_factors/pair_form_factor.h
//
// The common code of those form-factor methods that treat one pair of areas at a time, by rays or by
// integrals.

#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "solver/base/random.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// A sending polygon and a target polygon, with the patches that may block the sight between them.
struct SightedPair {
  const Scene& scene;
  PatchId sender_patch = kNoPatch, target_patch = kNoPatch;
  std::span<const Vec3> sender, target;  // vertices of the two convex polygons [m]
  // Patches that may block the sight: for every blocked segment between the two polygons, the list contains
  // at least one patch that blocks the segment.
  std::span<const PatchId> blockers;
  std::size_t rays = 0;
  // Two random generators: of_sender is the same for all targets of a sender, and of_pair belongs to this
  // pair of polygons only.
  Random of_sender, of_pair;

  const Vec3& SenderNormal() const { return scene.patches[static_cast<std::size_t>(sender_patch)].normal; }
  const Vec3& TargetNormal() const { return scene.patches[static_cast<std::size_t>(target_patch)].normal; }
};

// A function that returns F(sender -> target) with an estimate of its error. Several threads may call a
// PairRule at once.
using PairRule = std::function<FormFactorEstimate(const SightedPair&)>;

// True if no patch in pair.blockers intersects the segment between the two points.
bool InSight(const SightedPair& pair, const Vec3& from, const Vec3& to);

// Maps (s, t) in the unit square to a point of a convex polygon: uniform (s, t) give uniform points.
Vec3 UniformPoint(std::span<const Vec3> polygon, double s, double t);

// cos cos / (pi r^2) between two points [1/m^2]; the value is 0 if one point lies behind the plane of the
// other.
double PointKernel(const SightedPair& pair, const Vec3& at_sender, const Vec3& at_target);

// The mean of random samples, and the standard error of the mean.
class SampleMean {
 public:
  // Adds a sample with the value `value`; `most` is the value that the sample would have without blockers.
  void Add(double value, double most);
  // The estimated error of the mean of the samples is sqrt((standard error)^2 + (largest unblocked value /
  // number of samples)^2). The term (largest unblocked value / number of samples)^2 keeps the error above 0
  // if all samples happen to be blocked.
  FormFactorEstimate Estimate() const;

 private:
  double sum_ = 0, squares_ = 0, largest_ = 0;
  std::size_t count_ = 0;
};

class PairFormFactor final : public LinkFormFactorMethod {
 public:
  // `link_rays` is the default number of rays for the form factor of a link. `sampled` is true if the error
  // of each pair's form factor is an independent standard error.
  PairFormFactor(PairRule rule, std::size_t link_rays, bool sampled, const LinkFormFactorOptions& options);

  void Find(ReceiverLinks* links, const ExecutionContext& context) const override;
  // Each sending part casts a number of rays in proportion to its area. If the form factors of pairs of parts
  // have standard errors, the error of their sum is the root of the sum of squared errors; otherwise, it is
  // the sum of the errors.
  std::optional<FormFactorEstimate> Between(const Scene& scene, std::span<const AreaPart> from,
                                            std::span<const AreaPart> to,
                                            const ExecutionContext& context) const override;

 private:
  PairRule rule_;
  std::size_t rays_;
  bool sampled_;
  std::uint64_t seed_;
  bool factors_only_;
};

}  // namespace penumbra
