// experiments/reference/emitters.h
//
// Points on what shines, chosen so that their weights vary little (next-event estimation).

#pragma once

#include <array>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

struct EmitterSample {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();
  Rgb irradiance = Rgb::Zero();  // what the sample counts for if nothing is in between [W/m^2]
};

class Emitters {
 public:
  explicit Emitters(const Scene& scene);  // the scene must outlive it

  bool empty() const { return emitters_.empty(); }

  // A point on the front of an emitter for (u, v, w) in the unit cube, seen from the front of a surface at
  // `at`. For uniform (u, v, w) the mean of `irradiance`, where the two see each other, is the direct
  // irradiance. kNoPatch: the sample counts nothing. u chooses among emitters, by a rough guess at what they
  // bring; (v, w) a point: by area from afar, by solid angle (Arvo 1995) from near.
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

// The direction to a point of the spherical triangle with the unit vertices a, b, c, uniform in solid angle
// for uniform (v, w) (Arvo, Stratified sampling of spherical triangles, 1995). `area` is its solid angle.
Vec3 OnSphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c, double area, double v, double w);

// The solid angle of that triangle [sr] (Van Oosterom and Strackee 1983).
double SphericalTriangleArea(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace penumbra
