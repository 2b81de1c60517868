// solver/transport/points/shadow_rays.h
//
// The light of chosen surfaces, the luminaires, by shadow rays: emitters, and small surfaces that reflect so
// much that rays in random directions would find them too rarely. Rays decide how much of a luminaire a point
// sees; the unoccluded light is exact. Where rays find that an emitter is partly hidden and its light
// matters, the blockers may be cut out of it instead, as PointIrradiance does.

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
  // An emitter that is partly hidden is cut by its blockers if its unoccluded light exceeds this times the
  // light of all emitters that are seen; otherwise the rays decide which part of it is visible.
  double exact_above = 0.02;
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

  // The light of the luminaires at a point [W/m^2]. Adds the contributions, and the direct light of emitters,
  // to `parts`, unless null; `parts` gets no gradient. The value depends on the point and the effort alone.
  // May be called from any thread.
  Rgb At(const ReceiverPoint& at, const ShadowRayEffort& effort, IrradianceParts* parts = nullptr) const;

 private:
  // A luminaire as a point sees it.
  struct Seen {
    double light;  // estimate of the unoccluded light in the brightest channel [W/m^2]
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

    std::span<const Vec3> Vertices() const { return {vertex.data(), size}; }
  };
  struct Gathered;

  void AddLuminaire(PatchId patch, std::span<const Vec3> polygon, const Rgb& radiosity, bool emits);

  void FindSeen(const ReceiverPoint& at, std::vector<Seen>& seen) const;
  // Form factors by the midpoint rule: of the whole luminaire, and of the cells that are visible.
  struct RaySums {
    double all, visible;
  };
  RaySums CastRays(const Vec3& from, const ReceiverPoint& at, const Luminaire& luminaire,
                   const ShadowRayEffort& effort) const;
  Rgb Unhindered(const ReceiverPoint& at, const Luminaire& luminaire) const;
  Rgb Exact(const ReceiverPoint& at, PatchId emitter) const;
  void AddWeak(const Vec3& from, const ReceiverPoint& at, std::span<const Seen> weak,
               const ShadowRayEffort& effort, Gathered& sum) const;

  const Scene& scene_;
  const RayCaster& caster_;
  double lift_;  // of ends of rays from surfaces [m]
  SourceSet sources_;
  PatchHierarchy patches_;
  std::vector<Luminaire> luminaires_;
};

}  // namespace penumbra
