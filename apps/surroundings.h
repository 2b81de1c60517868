// apps/surroundings.h
//
// Examines the surroundings of points that the user gives: the face on which a point lies, and whether light
// can reach the point.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/points_csv.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

// A point lies on a patch if (distance of the point from the patch) / (length of the scene's diagonal) is at
// most kOnPatchDistance, and the normals of point and patch differ by at most kOnPatchDegrees degrees.
inline constexpr double kOnPatchDistance = 1e-6;
inline constexpr double kOnPatchDegrees = 1;

// A point is far outside if its distance from the scene's bounding box exceeds kFarDiagonals * (diagonal of
// the box). For example, points that the user gave in centimetres are far outside a scene in metres.
inline constexpr double kFarDiagonals = 10;

// The face and the patch on whose front a point lies.
struct PointFace {
  std::int32_t face = -1;  // number of the face in outputs; -1 if the point lies on no face
  PatchId patch = kNoPatch;
};

// The largest distance from a patch of the scene at which a point counts as lying on the patch [m].
double PatchReach(const Scene& scene);

// Finds the face on whose front the point lies; if the point lies on several fronts, the face with the lowest
// index. `normal` is the unit normal at the point; if it is nullopt, fronts of all orientations are accepted.
PointFace FindFace(const Scene& scene, const Vec3& position, const std::optional<Vec3>& normal);

// Sets the normal of each point without a normal to the normal of the face on which the point lies
// (FindFace). Throws InputError with the message "NAME:LINE: error: …" if a point without a normal lies on no
// face.
void TakeNormalsOfFaces(const Scene& scene, const std::string& name, std::vector<ProbePoint>* points);

class Surroundings {
 public:
  explicit Surroundings(const Scene& scene);  // the scene must outlive the object

  // True if the point lies far outside the scene's bounding box (kFarDiagonals).
  bool IsFar(const Vec3& position) const;
  // The two patches of a thin wall lie in one plane, except for rounding errors of their corners. Because of
  // rounding errors, the patch on the back of a thin wall may lie in front of the point `foot` on the front
  // patch `id`, and hide light. Returns the point `foot`, moved along the normal of patch `id` so that no
  // patch of the wall's back lies in front of the moved point.
  Vec3 BeforeBacks(PatchId id, const Vec3& foot) const;
  // True if only backs of patches are visible from the point with unit normal `normal`, which then lies
  // inside a solid or behind faces.
  bool SeesOnlyBacks(const Vec3& position, const Vec3& normal) const;

 private:
  const Scene& scene_;
  RayCaster rays_;
  double reach_;     // largest distance from a patch at which a point counts as lying on the patch [m]
  Vec3 low_, high_;  // corners of the scene's bounding box [m]
};

}  // namespace penumbra
