// solver/scene/plane_overlaps.h
//
// Finds outlines of the same orientation that overlap in one plane, within the precision of their
// coordinates.

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/plane_projection.h"
#include "solver/geometry/region_difference.h"
#include "solver/scene/outline.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Planes or edges of two faces count as the same if their distance is at most kCoplanarTolerance * (larger
// diameter of the two faces). kCoplanarTolerance exceeds the effect of rounding coordinates to binary64
// (1e-16, and 1e-12 for a small face far from the origin), and is smaller than any intended distance.
inline constexpr double kCoplanarTolerance = 1e-9;

// The upper limit of the distance within which planes count as the same, relative to the scene's diagonal.
// Without the limit kCoarsestPlane, coordinates such as 1 and 2, which may be exact, would have a tolerance
// of about 1.
inline constexpr double kCoarsestPlane = 1e-3;

// The distances within which corners, edges and planes count as the same, given the unit to which coordinates
// are rounded.
class PlaneTolerance {
 public:
  // `step`: the unit to which coordinates are rounded, per axis [m]; zero if they are exact.
  PlaneTolerance(const Vec3& step, double diagonal);

  // The distance within which corners and edges of two faces count as the same. The faces have the diameter
  // `diameter`, and lie in a plane with the projection `projection`.
  SnapTolerance InPlane(const PlaneProjection& projection, double diameter) const;

  // The distance within which two planes with the unit normal `normal` count as the same [m]. Each plane is
  // defined by rounded corners.
  double Between(const Vec3& normal) const;

  // The distance within which two planes always count as the same [m], whatever their orientation and the
  // rounding of coordinates. It equals ContactGap().
  double Least() const { return least_; }

  // The largest distance within which two planes of any orientation count as the same [m].
  double Largest() const;

 private:
  double least_;
  Vec3 step_;  // slightly less than the unit, limited by kCoarsestPlane
};

std::vector<Vec2> Project(const PlaneProjection& projection, std::span<const Vec3> points);

// Sets Outline::winners for outlines that overlap in one plane; of two outlines, the one of lower rank wins.
// Returns the largest distance between planes that count as one [m]. The time is nearly linear unless many
// bounding boxes intersect.
double FindOverlaps(std::vector<Outline>& outlines, std::span<const std::int32_t> rank,
                    const PlaneTolerance& tolerance);

// The largest distance at which two planes of the scene count as one, over all orientations [m].
double LargestPlaneDistance(const Scene& scene);

}  // namespace penumbra
