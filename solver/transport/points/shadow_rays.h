// solver/transport/points/shadow_rays.h
//
// The light of chosen surfaces, the luminaires, by shadow rays: emitters, and small surfaces that reflect so
// much that rays in random directions would find them too rarely. Rays decide how much of a luminaire a point
// sees; the unoccluded light is exact. Where rays find that an emitter is partly hidden and its light
// matters, more rays decide, or the blockers are cut out of it, as PointIrradiance does.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/transport/points/gathering.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/pair/patch_hierarchy.h"
#include "solver/visibility/point/ray_caster.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// How accurate the light of luminaires shall be.
struct ShadowRayEffort {
  // A luminaire that sends a twentieth of the unoccluded light of all, or more, gets divisions^2 rays, one to
  // each of as many cells of equal area. Weaker ones get rays in proportion to their light. With 0 divisions,
  // a single ray goes to one luminaire, chosen in proportion to the light of all: right on average over many
  // seeds.
  int divisions = 4;
  // An emitter that is partly hidden deserves more effort if its unoccluded light exceeds this times the
  // light of all emitters that are seen. Otherwise the rays above decide which part of it is visible.
  double closer_above = 0.02;
  // The effort: this number of rays, or, if 0, its blockers are cut out of it exactly.
  int rays_if_hidden = 0;
  std::uint64_t seed = 0;  // of the places in the cells; 0: their centres
};

// A surface that reflects much light, taken for constant.
struct BrightReflector {
  PatchId patch = kNoPatch;
  Polygon3 polygon;             // [m]
  Rgb radiosity = Rgb::Zero();  // the reflected part [W/m^2]
};

class ShadowRays {
 public:
  // The luminaires are the emitters, with their emittance, and the reflectors. Scene and caster must outlive
  // the object.
  ShadowRays(const Scene& scene, const RayCaster& caster, std::span<const BrightReflector> reflectors = {});

  // The most points that one call of AtAll() takes.
  static constexpr std::size_t kTogether = RayCaster::kPacket;
  // Sets irradiance[i] to the light of the luminaires at points[i] [W/m^2]. Rays of neighbouring points are
  // traced together. Adds the contributions, and the direct light of emitters, at the first point to `parts`,
  // unless null; `parts` gets no gradient. The points share the places on weak luminaires to
  // which rays go, so that a value depends on all points of the call, and on the effort. May be
  // called from any thread. REQUIRES: at most kTogether points with equal normals, and as many values.
  void AtAll(std::span<const ReceiverPoint> points, const ShadowRayEffort& effort, std::span<Rgb> irradiance,
             IrradianceParts* parts = nullptr) const;
  // The same for one point.
  Rgb At(const ReceiverPoint& at, const ShadowRayEffort& effort, IrradianceParts* parts = nullptr) const;

 private:
  using Values = std::array<double, kTogether>;  // one for each point of a group
  // A luminaire as a group of points sees it.
  struct Seen {
    Values light;  // estimate of the unoccluded light in the brightest channel [W/m^2]
    double total;
    std::size_t luminaire;
  };
  struct Luminaire {
    PatchId patch;
    bool emits;
    std::array<Vec3, 4> vertex;
    std::size_t size;  // 3 or 4
    Vec3 centre, normal;
    double radius, area;
    Rgb radiosity;      // [W/m^2]
    double brightness;  // in the brightest channel [W/m^2]
    bool is_parallelogram;

    std::span<const Vec3> Vertices() const { return {vertex.data(), size}; }
    // Uniformly distributed over the luminaire if (s, t) are uniformly distributed over the unit square.
    Vec3 Place(double s, double t) const;
  };
  struct Group;
  // Form factors of a luminaire, and of its visible part, from rays to places on it. Some functions omit a
  // common factor.
  struct RaySums {
    Values all{}, visible{};
  };

  void AddLuminaire(PatchId patch, std::span<const Vec3> polygon, const Rgb& radiosity, bool emits);
  static std::uint32_t PointsLitBy(const Seen& seen);
  double Estimate(const ReceiverPoint& at, const Luminaire& luminaire) const;
  void FindSeen(Group& group, std::vector<Seen>& seen) const;
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
  double lift_;  // of ends of rays from surfaces [m]
  SourceSet sources_;
  PatchHierarchy patches_;
  std::vector<Luminaire> luminaires_;
};

}  // namespace penumbra
