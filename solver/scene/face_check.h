// solver/scene/face_check.h
//
// Checks whether a face of a scene file can be used, and repairs the face if possible. All functions take
// time O(n log n) for n vertices.

#pragma once

#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// A face counts as planar if (distance of a vertex from the face's plane) / (diameter of the face) is at most
// kPlanarTolerance for every vertex.
inline constexpr double kPlanarTolerance = 1e-6;
// A face that is not planar is cut into planar pieces if (distance of a vertex from the face's plane)
// / (diameter of the face) is at most kCutTolerance. Surveyed walls and faces with few decimals deviate less
// from a plane than kCutTolerance; a face with a larger deviation was not intended to be planar.
inline constexpr double kCutTolerance = 0.05;

// A face with width / diameter <= kZeroWidth has no reliable normal: rounding the coordinates rotates the
// normal by more than 1e-4.
inline constexpr double kZeroWidth = 1e-12;

// The upper limit of (rounding of a face's coordinates) / (diameter of the face). The limit kMostRounding is
// needed because files that contain only whole numbers do not show to which unit they were rounded.
inline constexpr double kMostRounding = 1e-4;

enum class FaceCondition {
  kFine,
  kZeroArea,
  // Not planar: the largest (distance of a vertex from the face's plane) / (diameter of the face) exceeds
  // kPlanarTolerance, but not FaceTolerances::cut.
  kUneven,
  // (distance of a vertex from the face's plane) / (diameter of the face) exceeds FaceTolerances::cut.
  kFolded,
  kSelfCrossing
};

// The permitted deviations of a face of a scene file.
struct FaceTolerances {
  // The largest permitted (distance of a vertex from the face's plane) / (diameter of the face).
  double cut = kCutTolerance;
  double rounding = 0;  // the largest rounding error of the difference of two of the face's vertices [m]
};

struct FaceCheck {
  FaceCondition condition = FaceCondition::kFine;
  // The largest distance of a vertex from the plane of the face [m], valid if the area is not 0.
  double off_plane = 0;
  double diameter = 0;  // the largest distance between two vertices of the face [m]
};

// Removes vertices that equal their predecessor, and spikes: the vertices a, b, a become a. Returns the
// number of removed vertices.
int RemoveRepeatedVertices(Polygon3& face);

// Returns whether the face can be used, or which defect it has (FaceCondition). If several conditions apply,
// the result is the first of: zero area, folded, self-crossing, uneven. A face may touch itself, for instance
// if a doubled edge joins a hole to the outline. A face is self-crossing if its winding number is neither 0
// nor 1 (for a reversed face, -1) in some triangle that is wider than the rounding of its vertices. The
// rounding of a face's vertices is `tolerances.rounding`, but at most kMostRounding * (diameter of the face).
// A face that crosses itself and is nowhere wider than the rounding of its vertices has zero area. The
// condition of a face does not depend on the direction in which its vertices run or on the first vertex.
FaceCheck CheckFace(const Polygon3& face, const FaceTolerances& tolerances = {});

// Returns the face itself if it is planar; otherwise triangles that fill the face and whose vertices equal
// those of the face to the bit. A quadrilateral is cut along the diagonal that gives the better shaped
// triangles. A face with reversed order of vertices gives the same triangles, each with reversed order of
// vertices. REQUIRES: CheckFace() returns kFine or kUneven.
std::vector<Polygon3> FlatPieces(const Polygon3& face);

}  // namespace penumbra
