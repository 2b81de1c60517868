// solver/transport/form_factors/pair_form_factor.h
//
// Form factors that are found pair by pair, by rays or by integrals: what these methods have in common.

#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "solver/base/random.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// A part of a patch that sends, one that receives, and what may stand between them.
struct SightedPair {
  const Scene& scene;
  PatchId sender_patch = kNoPatch, target_patch = kNoPatch;
  std::span<const Vec3> sender, target;  // convex [m]
  std::span<const PatchId> blockers;     // one at least of every blocked segment's
  std::size_t rays = 0;
  Random of_sender, of_pair;  // the same for all pairs of a sender; of this pair alone

  const Vec3& SenderNormal() const { return scene.patches[static_cast<std::size_t>(sender_patch)].normal; }
  const Vec3& TargetNormal() const { return scene.patches[static_cast<std::size_t>(target_patch)].normal; }
};

// F(sender -> target) with an estimate of its error. May be called from several threads.
using PairRule = std::function<FormFactorEstimate(const SightedPair&)>;

// True if no blocker of the pair crosses the segment.
bool InSight(const SightedPair& pair, const Vec3& from, const Vec3& to);

// Maps (s, t) in the unit square to a point of a convex polygon: uniform (s, t) give uniform points.
Vec3 UniformPoint(std::span<const Vec3> polygon, double s, double t);

// cos cos / (pi r^2) between two points [1/m^2]; 0 if one of them lies behind the other's plane.
double PointKernel(const SightedPair& pair, const Vec3& at_sender, const Vec3& at_target);

// The mean of random values and its standard error.
class SampleMean {
 public:
  // `most` is the value if nothing blocked the sight.
  void Add(double value, double most);
  // The error is the standard error, together with (the largest unblocked value) / count, so that it is not 0
  // because all samples were blocked by chance.
  FormFactorEstimate Estimate() const;

 private:
  double sum_ = 0, squares_ = 0, largest_ = 0;
  std::size_t count_ = 0;
};

class PairFormFactor final : public LinkFormFactorMethod {
 public:
  // `link_rays`: rays for the form factor of a link, unless the options say otherwise. `sampled`: the errors
  // of pairs are independent standard errors.
  PairFormFactor(PairRule rule, std::size_t link_rays, bool sampled, const LinkFormFactorOptions& options);

  void Find(ReceiverLinks* links, const ExecutionContext& context) const override;
  // The rays are shared out among the senders by area. Standard errors add up as squares, others as they are.
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
