// solver/scene/plane_overlaps.h
//
// Which outlines lie on one another in one plane and look the same way, by what their coordinates can tell.

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/plane_projection.h"
#include "solver/geometry/region_difference.h"
#include "solver/scene/outline.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Relative to the larger diameter: what the rounding of coordinates to binary64 leaves of a common plane or a
// common edge (1e-16, and 1e-12 for a small face far from the origin), and too near for any two that are
// meant to be apart.
inline constexpr double kCoplanarTolerance = 1e-9;

// What a common plane is at most, relative to the scene's diagonal, however few digits are written: who
// writes 1 and 2 may mean them exactly.
inline constexpr double kCoarsestPlane = 1e-3;

// How far apart the digits of coordinates leave what is the same.
class PlaneTolerance {
 public:
  // `step`: the units in which coordinates are written [m], zero where they are exact.
  PlaneTolerance(const Vec3& step, double diagonal);

  // Between corners and edges in a plane of that projection, of faces of that diameter.
  SnapReach InPlane(const PlaneProjection& projection, double diameter) const;

  // Between two planes with that unit normal, both of which rounded corners carry [m].
  double Between(const Vec3& normal) const;

  // Between any two planes: nearer than that things touch (ContactGap()), and a point on one is on the other.
  double Least() const { return least_; }

  // The largest of them all [m].
  double Largest() const;

 private:
  double least_;
  Vec3 step_;  // just less than a unit, and no more than the coarsest plane
};

std::vector<Vec2> Project(const PlaneProjection& projection, std::span<const Vec3> points);

// Sets the winners of outlines that overlap in one plane; of two, the one of lower rank wins. Returns the
// largest distance between planes that count as one [m]. Time is near linear unless many boxes meet.
double FindOverlaps(std::vector<Outline>& outlines, std::span<const std::int32_t> rank,
                    const PlaneTolerance& tolerance);

// How far apart planes may be that count as one, however they are turned [m].
double LargestPlaneDistance(const Scene& scene);

}  // namespace penumbra
