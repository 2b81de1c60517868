// apps/surroundings.h
//
// Looks around at points of the user's choice: what light cannot reach, and on which face a point lies.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/points_csv.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

// A point lies on a patch if its distance is at most kOnPatchDistance times the scene's diagonal, and its
// normal deviates by at most kOnPatchDegrees degrees.
inline constexpr double kOnPatchDistance = 1e-6;
inline constexpr double kOnPatchDegrees = 1;

// A point is far outside if its distance from the scene's bounding box exceeds kFarDiagonals * (diagonal of
// the box). For example, points that the user gave in centimetres are far outside a scene in metres.
inline constexpr double kFarDiagonals = 10;

// The face and the patch on whose front a point lies.
struct PointFace {
  std::int32_t face = -1;  // its number in outputs; -1: none
  PatchId patch = kNoPatch;
};

// The distance within which a point lies on a patch of the scene [m].
double PatchReach(const Scene& scene);

// The face on whose front the point lies; if the point lies on several fronts, the face with the lowest
// index. `normal` is a unit vector; without it, any front at the position counts.
PointFace FindFace(const Scene& scene, const Vec3& position, const std::optional<Vec3>& normal);

// Gives each point without a normal that of the face on which it lies (FindFace). Throws InputError,
// "NAME:LINE: error: …", for a point that lies on no face.
void TakeNormalsOfFaces(const Scene& scene, const std::string& name, std::vector<ProbePoint>* points);

class Surroundings {
 public:
  explicit Surroundings(const Scene& scene);  // which must outlive this object

  // True if the point lies far outside the scene.
  bool IsFar(const Vec3& position) const;
  // The two faces of a thin wall lie in one plane, but for the rounding of their corners: a foot on the plane
  // of one may lie behind the other. Returns the foot on the side of both where its own face looks.
  Vec3 BeforeBacks(PatchId id, const Vec3& foot) const;
  // True if a point with this unit normal lies inside a solid or behind faces: it sees only backs.
  bool SeesOnlyBacks(const Vec3& position, const Vec3& normal) const;

 private:
  const Scene& scene_;
  RayCaster rays_;
  double reach_;     // [m]
  Vec3 low_, high_;  // of the scene's bounding box [m]
};

}  // namespace penumbra
