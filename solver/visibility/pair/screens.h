// solver/visibility/pair/screens.h
//
// Patches that hide much at once: what lies in their shadows need not be looked at one by one.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// All p with normal . p >= offset; the normal is unit.
struct HalfSpace {
  Vec3 normal = Vec3::Zero();
  double offset = 0;  // [m]
};

// A convex region: what lies in all of its half-spaces.
using ConvexRegion = std::vector<HalfSpace>;

// A patch that hides all that lies in its shadow.
struct Screen {
  PatchId patch = kNoPatch;
  ConvexRegion shadow;
};

// Where nothing is seen from any of the points, nor from between them, because the patch stands before it:
// what is hidden from several points is hidden from their convex hull. Empty if the patch's plane contains
// one of them or separates them.
ConvexRegion ShadowRegion(std::span<const ReceiverPoint> from, const Patch& patch);

// Finds screens among the largest patches of a scene, which must outlive it.
class ScreenFinder {
 public:
  ScreenFinder() = default;
  explicit ScreenFinder(const Scene& scene);

  // Replaces `screens` by up to `count` patches that fill a large part of what is seen from the points, none
  // of them in the shadow of another: by an estimate at least `least` [sr], the largest first.
  void Find(std::span<const ReceiverPoint> from, double least, std::size_t count,
            std::vector<Screen>& screens) const;

 private:
  const Scene* scene_ = nullptr;
  std::vector<PatchId> patch_;
  std::array<std::vector<double>, 3> centre_;  // [m]
  std::vector<double> area_;                   // [m^2]
};

}  // namespace penumbra
