// experiments/reference/emitters.h
//
// Chooses random points on emitters for next-event estimation, such that the weights of the points vary
// little.

#pragma once

#include <array>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

struct EmitterSample {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();
  Rgb irradiance = Rgb::Zero();  // irradiance that the sample stands for if nothing blocks it [W/m^2]
};

class Emitters {
 public:
  explicit Emitters(const Scene& scene);  // `scene` must outlive the object

  bool empty() const { return emitters_.empty(); }

  // Maps (u, v, w) in the unit cube to a point on the front of an emitter, for a receiver at `at` with the
  // normal `normal`. If (u, v, w) is uniformly distributed, the mean of EmitterSample::irradiance over all
  // samples is the direct irradiance. In the mean of EmitterSample::irradiance, samples that the receiver
  // does not see count as zero. If the patch of a sample is kNoPatch, the sample contributes nothing. The
  // number u chooses an emitter, with probabilities from a rough estimate of each emitter's contribution. The
  // numbers (v, w) choose a point on the emitter, uniformly by area if the emitter is distant, and by solid
  // angle (Arvo 1995) if it is near.
  EmitterSample Sample(const Vec3& at, const Vec3& normal, double u, double v, double w) const;

 private:
  struct Emitter {
    PatchId patch;
    Vec3 centre;
    double radius, strength;  // [m], [W/m^2]
    Rgb emittance;
    bool parallelogram;
  };
  double Guess(const Emitter& emitter, const Vec3& at, const Vec3& normal) const;
  EmitterSample ByArea(const Emitter& emitter, const Vec3& at, const Vec3& normal, double v, double w) const;
  EmitterSample BySolidAngle(const Emitter& emitter, const Vec3& at, const Vec3& normal, double v,
                             double w) const;

  const Scene* scene_;
  std::vector<Emitter> emitters_;
};

// Returns the direction to a point of the spherical triangle with the unit vertices a, b and c. The direction
// is uniformly distributed in solid angle if (v, w) is uniform (Arvo, Stratified sampling of spherical
// triangles, 1995). `area` is the solid angle of the spherical triangle [sr].
Vec3 OnSphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c, double area, double v, double w);

// Returns the solid angle of the spherical triangle with the unit vertices a, b and c [sr] (Van Oosterom and
// Strackee 1983).
double SphericalTriangleArea(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace penumbra
