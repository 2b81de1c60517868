// solver/scene/plane_overlaps.h
//
// Finds outlines (planar polygons) of the same orientation that overlap in one plane, within the precision of
// their coordinates.

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/plane_projection.h"
#include "solver/geometry/region_difference.h"
#include "solver/scene/outline.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Planes or edges of two faces count as equal if their distance is at most kCoplanarTolerance * (larger
// diameter of the two faces). The tolerance kCoplanarTolerance exceeds the effect of rounding coordinates to
// binary64 (1e-16, and 1e-12 for a small face far from the origin), and is smaller than any intended
// distance.
inline constexpr double kCoplanarTolerance = 1e-9;

// The distance within which planes count as equal is at most kCoarsestPlane * (length of the scene's
// diagonal). Without the limit kCoarsestPlane, the tolerance for integer coordinates such as 1 and 2, which
// may be exact, would be about 1.
inline constexpr double kCoarsestPlane = 1e-3;

// The distances within which corners, edges and planes count as equal, computed from the unit to which
// coordinates are rounded.
class PlaneTolerance {
 public:
  // `step` is the unit to which coordinates are rounded, for each axis [m]; zero if the coordinates are
  // exact. `diagonal` is the length of the scene's diagonal [m].
  PlaneTolerance(const Vec3& step, double diagonal);

  // The distance within which corners and edges of two faces count as equal. `diameter` is the larger
  // diameter of the faces [m]; `projection` maps the common plane of the faces to two dimensions.
  SnapTolerance InPlane(const PlaneProjection& projection, double diameter) const;

  // The distance within which two planes with the unit normal `normal` count as equal [m], if each plane is
  // defined by rounded corners.
  double Between(const Vec3& normal) const;

  // The smallest tolerance for planes [m]: two planes within this distance count as equal, whatever their
  // orientation and the rounding of coordinates. Least() equals ContactGap().
  double Least() const { return least_; }

  // The largest tolerance for planes [m]: the maximum of Least() and of Between() over all orientations.
  double Largest() const;

 private:
  double least_;
  Vec3 step_;  // slightly less than the unit to which coordinates are rounded, limited by kCoarsestPlane
};

std::vector<Vec2> Project(const PlaneProjection& projection, std::span<const Vec3> points);

// Sets Outline::winners for outlines that overlap in one plane; of two overlapping outlines, the outline with
// the lower rank keeps the overlap. Returns the largest distance between two planes that were taken as equal
// [m]. The time is nearly linear in the number of outlines unless many bounding boxes intersect.
double FindOverlaps(std::vector<Outline>& outlines, std::span<const std::int32_t> rank,
                    const PlaneTolerance& tolerance);

// The largest distance within which two planes of the scene count as equal, over all orientations [m].
double LargestPlaneDistance(const Scene& scene);

}  // namespace penumbra
