// solver/transport/points/final_gather.h
//
// Final gathering (Reichert 1992): the irradiance at a point, from a radiosity solution that stores one mean
// radiosity per element. Direct light is computed by shadow rays (ShadowRays). Reflected light is gathered by
// rays in a fixed, cosine-distributed pattern of directions: each ray brings the reflected radiosity of the
// element that the ray hits. All points with the same normal use the same ray directions, so that the
// irradiance of neighbouring points varies smoothly, without noise. The time of a final gather grows only
// with the logarithm of the number of polygons in the scene.
//
// The median relative error of a final gather with n rays is about 0.1 / sqrt(n), measured in a scene of
// 5,802 patches.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/points/shadow_rays.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

struct FinalGatherOptions {
  std::size_t rays = 1024;  // number of rays from each point, to gather reflected light
  ShadowRayEffort shadows;
  std::uint64_t seed = 0;  // seed of the pattern of ray directions
  // If `regather` is false, a ray brings the radiosity that the solution stores for the element at the hit.
  // If `regather` is true, the irradiance at the hit is computed anew: direct light by shadow rays from the
  // hit, reflected light by one more ray. A final gather with `regather` takes much more time than without.
  // With `regather`, errors of the stored radiosities affect only light that was reflected at least twice,
  // and the light of strongly reflecting elements.
  bool regather = false;
};

class FinalGather {
 public:
  // Copies the required data of the solution. The scene of the solution must outlive the FinalGather.
  explicit FinalGather(const RadiositySolution& solution, const FinalGatherOptions& options);

  // The irradiance at a point [W/m^2]. If `parts` is not null, At() sets the direct light and the
  // contributions in `parts`, but no gradient. Any thread may call At().
  Rgb At(const ReceiverPoint& at, IrradianceParts* parts = nullptr) const;

  // The largest number of points in one call of AtAll().
  static constexpr std::size_t kTogether = RayCaster::kPacket;
  // Sets irradiance[i] to the irradiance at points[i]. Rays of neighbouring points are traced together as a
  // packet. Values of AtAll() differ from those of At() only because all points of a call send shadow rays to
  // the same places on weak emitters (ShadowRays). REQUIRES: `points` has at most kTogether points, with
  // equal normals; `irradiance` has the same size.
  void AtAll(std::span<const ReceiverPoint> points, std::span<Rgb> irradiance) const;

  // Bit i of the result is set if another surface touches the surface at points[i], so that the irradiance
  // may jump at the point. At a point whose bit is set, the irradiance is a one-sided limit from the
  // direction ReceiverPoint::approach. REQUIRES: `points` has at most kTogether points, with equal normals.
  std::uint32_t AreOneSided(std::span<const ReceiverPoint> points) const;

  // A FinalGather from the same solution with other options.
  FinalGather With(const FinalGatherOptions& options) const;
  const FinalGatherOptions& options() const { return options_; }

 private:
  // The data of a FinalGather that do not depend on FinalGatherOptions.
  struct Shared;
  FinalGather(std::shared_ptr<const Shared> shared, const FinalGatherOptions& options);
  void MakeDirections();
  Rgb RadiosityAt(PatchId patch, const Vec3& point, std::size_t ray) const;
  void AddReflected(std::span<const ReceiverPoint> points, std::span<Rgb> irradiance,
                    IrradianceParts* parts) const;

  std::shared_ptr<const Shared> shared_;
  FinalGatherOptions options_;
  std::vector<Vec3> directions_;  // ray directions, in a frame whose z axis is the surface normal
};

}  // namespace penumbra
