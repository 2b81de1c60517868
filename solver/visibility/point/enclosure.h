// solver/visibility/point/enclosure.h
//
// Finds points that nobody can see, because backs of patches surround them: where the end of a board is
// inside of another piece of furniture, or a leg inside of a floor.

#pragma once

#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

// Unit vectors that look around on the side of the unit vector `normal`: `normal` itself, and two rings of
// six, 45 and 75 degrees from it.
std::vector<Vec3> LookAround(const Vec3& normal);

class Enclosure {
 public:
  // The scene must outlive the Enclosure.
  explicit Enclosure(const Scene& scene);

  // True if every ray of LookAround() from the point on a front hits the back of a patch. Surrounds() is a
  // test by few rays: use it only for points that get no light. May be called from any thread.
  bool Surrounds(const Vec3& position, const Vec3& normal) const;

 private:
  RayCaster rays_;
  double lift_;  // the distance from the surface at which rays begin [m]
};

}  // namespace penumbra
