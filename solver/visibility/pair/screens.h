// solver/visibility/pair/screens.h
//
// Screens: patches that hide a large part of the view. Patches that lie in the shadow of a screen need no
// further visibility tests.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// A half-space: the points p with dot(normal, p) >= offset, where `normal` is a unit vector.
struct HalfSpace {
  Vec3 normal = Vec3::Zero();
  double offset = 0;  // distance of the border plane from the origin, along `normal` [m]
};

// A convex region, given as the intersection of half-spaces.
using ConvexRegion = std::vector<HalfSpace>;

// A screen: a large patch, with its shadow, the region that the patch hides.
struct Screen {
  PatchId patch = kNoPatch;
  ConvexRegion shadow;
};

// The region that the patch hides from all points of `from`, and thus from the convex hull of these points.
// The hidden region is empty if the patch's plane contains one of the points or separates the points.
ConvexRegion ShadowRegion(std::span<const ReceiverPoint> from, const Patch& patch);

// Finds screens, patches that hide much of the view, among the largest patches of a scene. The scene must
// outlive the ScreenFinder.
class ScreenFinder {
 public:
  ScreenFinder() = default;
  explicit ScreenFinder(const Scene& scene);

  // Sets `screens` to at most `count` screens, in descending order of their estimated solid angles as seen
  // from the points `from`. The estimated solid angle of each screen is at least `least` [sr]. No screen is
  // completely hidden behind an earlier screen of the list.
  void Find(std::span<const ReceiverPoint> from, double least, std::size_t count,
            std::vector<Screen>& screens) const;

 private:
  const Scene* scene_ = nullptr;
  std::vector<PatchId> patch_;
  std::array<std::vector<double>, 3> centre_;  // the coordinates x, y and z of the centres of all patches [m]
  std::vector<double> area_;                   // the areas of all patches [m^2]
};

}  // namespace penumbra
