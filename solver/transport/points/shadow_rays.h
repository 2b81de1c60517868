// solver/transport/points/shadow_rays.h
//
// Computes the light of luminaires at a point by shadow rays. Luminaires are the emitters, and small surfaces
// that reflect so much light that rays in random directions would hit these surfaces too rarely. Shadow rays
// estimate the visible fraction of a luminaire; the unoccluded light of the luminaire is exact. If an emitter
// is found to be partly hidden and its light matters, more shadow rays are cast, or the blockers are cut out
// of the emitter exactly, as in PointIrradiance.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/transport/points/gathering.h"
#include "solver/transport/points/hidden_luminaires.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/pair/patch_hierarchy.h"
#include "solver/visibility/point/ray_caster.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// The effort for the light of luminaires: numbers of shadow rays and the condition for exact visibility.
struct ShadowRayEffort {
  // A luminaire is divided into divisions^2 cells, with one shadow ray to each cell, if it sends at least a
  // twentieth of the unoccluded light of all luminaires. Weaker luminaires get shadow rays in proportion to
  // their light. If `divisions` is 0, a single ray goes to one luminaire, chosen with a probability in
  // proportion to its light; the mean over many seeds converges to the light of all luminaires.
  int divisions = 4;
  // A partly hidden emitter gets more shadow rays, or exact visibility, if its unoccluded light exceeds
  // closer_above * (light of all visible luminaires); see rays_if_hidden. If the unoccluded light of a partly
  // hidden emitter is at most closer_above * (light of all visible luminaires), the divisions^2 shadow rays
  // alone determine the visible fraction of the emitter.
  double closer_above = 0.02;
  // The number of shadow rays to a partly hidden emitter whose light exceeds the limit given by closer_above.
  // If rays_if_hidden is 0, the blockers are cut out of the emitter exactly.
  int rays_if_hidden = 0;
  // Seed of the random end points of shadow rays in the cells of a luminaire; with 0, shadow rays end at the
  // centres of the cells.
  std::uint64_t seed = 0;
};

// A polygon that reflects much light, treated as a luminaire of constant radiosity.
struct BrightReflector {
  PatchId patch = kNoPatch;
  Polygon3 polygon;             // vertices of the polygon [m]
  Rgb radiosity = Rgb::Zero();  // the reflected radiosity, without emittance [W/m^2]
};

class ShadowRays {
 public:
  // The luminaires are the emitters of the scene, with their emittance, and the given reflectors. `scene` and
  // `caster` must outlive the ShadowRays.
  ShadowRays(const Scene& scene, const RayCaster& caster, std::span<const BrightReflector> reflectors = {});

  // Finds out which luminaires the surfaces around the given points do not see. After Learn(), a point in a
  // region (cube of the given side [m]) sends fewer rays to the luminaires that no given point in this region
  // sees, unless exact visibility is asked for (rays_if_hidden is 0 and closer_above is finite). The expected
  // value of the light is the same with and without Learn(). The given points should be spread over all
  // surfaces of the scene, with many points in each region. Learn() does nothing if the scene has few
  // luminaires.
  void Learn(std::span<const ReceiverPoint> points, double side);

  // The largest number of points in one call of AtAll().
  static constexpr std::size_t kTogether = RayCaster::kPacket;
  // Sets irradiance[i] to the light of the luminaires at points[i] [W/m^2]. Rays of neighbouring points are
  // traced together as a packet. If `parts` is not null, AtAll() adds the contributions of the luminaires,
  // and the direct light of emitters, at the first point to `parts`; `parts` gets no gradient. All points of
  // a call of AtAll() send rays to the same places on weak luminaires, so that the value at a point depends
  // on the other points of the call. Any thread may call AtAll(). REQUIRES: `points` has at most kTogether
  // points, with equal normals; `irradiance` has the same size.
  void AtAll(std::span<const ReceiverPoint> points, const ShadowRayEffort& effort, std::span<Rgb> irradiance,
             IrradianceParts* parts = nullptr) const;
  // The light of the luminaires at a single point [W/m^2].
  Rgb At(const ReceiverPoint& at, const ShadowRayEffort& effort, IrradianceParts* parts = nullptr) const;

 private:
  using Values = std::array<double, kTogether>;  // one value for each point of a group of points
  // The unoccluded light of one luminaire at a group of points.
  struct Seen {
    // An estimate of the irradiance from the unoccluded luminaire, in the brightest channel [W/m^2]. The
    // estimate is multiplied by 1/8 if the luminaire is probably hidden from all points of the group
    // (HiddenLuminaires).
    Values light;
    double total;
    std::size_t luminaire;
  };
  struct Luminaire {
    PatchId patch;
    bool emits;
    std::array<Vec3, 4> vertex;
    std::size_t size;  // number of the luminaire's vertices: 3 or 4
    Vec3 centre, normal;
    double radius, area;
    Rgb radiosity;      // radiosity of the luminaire [W/m^2]
    double brightness;  // radiosity of the luminaire in the brightest channel [W/m^2]
    bool is_parallelogram;

    std::span<const Vec3> Vertices() const { return {vertex.data(), size}; }
    // Maps (s, t) to a point of the luminaire; uniform (s, t) in the unit square give uniformly distributed
    // points.
    Vec3 Place(double s, double t) const;
  };
  struct Group;
  // Sums over rays to places on a luminaire: `all` is proportional to the form factor of the whole luminaire,
  // `visible` to that of its visible part.
  struct RaySums {
    Values all{}, visible{};
  };

  void AddLuminaire(PatchId patch, std::span<const Vec3> polygon, const Rgb& radiosity, bool emits);
  static std::uint32_t PointsLitBy(const Seen& seen);
  double Estimate(const ReceiverPoint& at, const Luminaire& luminaire) const;
  bool IsNear(const ReceiverPoint& at, const Luminaire& luminaire) const;
  bool Sees(const ReceiverPoint& at, const Luminaire& luminaire, std::size_t ray) const;
  void FindHidden(std::span<const ReceiverPoint> points, std::span<std::uint64_t> hidden) const;
  void FindSeen(Group& group, bool trusts_region, std::vector<Seen>& seen) const;
  void AddPlace(const Group& group, std::uint32_t which, const Luminaire& luminaire, const Vec3& to,
                RaySums& sums) const;
  RaySums CastRays(const Group& group, std::uint32_t which, const Luminaire& luminaire,
                   const ShadowRayEffort& effort) const;
  RaySums CastMoreRays(const Group& group, std::uint32_t which, const Luminaire& luminaire,
                       const ShadowRayEffort& effort) const;
  Rgb Unhindered(const ReceiverPoint& at, const Luminaire& luminaire) const;
  Rgb Exact(const ReceiverPoint& at, PatchId emitter) const;
  void AddStrong(const Seen& strong, const Values& rest, const ShadowRayEffort& effort, Group& group) const;
  void AddWeak(std::span<const Seen> weak, const ShadowRayEffort& effort, Group& group) const;

  const Scene& scene_;
  const RayCaster& caster_;
  double lift_;  // distance between the end points of rays and the surfaces [m]
  SourceSet sources_;
  PatchHierarchy patches_;
  std::vector<Luminaire> luminaires_;
  HiddenLuminaires hidden_;
  double near_ = 0;  // luminaires within this distance of a region never count as hidden [m]
};

}  // namespace penumbra
