// solver/scene/face_check.h
//
// Checks whether a face of a file can be used, and repairs it. All functions take time O(n log n) for n
// vertices.

#pragma once

#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// The largest distance of a vertex from its face's plane in a planar face, relative to the face's diameter.
inline constexpr double kPlanarTolerance = 1e-6;
// The largest distance of a vertex from its face's plane, relative to the face's diameter, in a face that is
// cut into planar pieces. Surveyed walls and faces with few decimals deviate by less; a face with a larger
// deviation was not intended to be planar.
inline constexpr double kCutTolerance = 0.05;

// A face with width / diameter <= kZeroWidth has no reliable normal: rounding the coordinates rotates the
// normal by more than 1e-4.
inline constexpr double kZeroWidth = 1e-12;

// The largest part of a face's diameter that is taken for a rounding of its coordinates. Files with whole
// numbers only do not say to what they were rounded.
inline constexpr double kMostRounding = 1e-4;

enum class FaceCondition {
  kFine,
  kZeroArea,
  kUneven,  // deviates by more than kPlanarTolerance, at most FaceTolerances::cut: FlatPieces() cuts it
  kFolded,  // deviates by more than FaceTolerances::cut
  kSelfCrossing
};

// What a face of a file may deviate by.
struct FaceTolerances {
  double cut = kCutTolerance;  // of a vertex from the plane of a face that is cut, relative to its diameter
  double rounding = 0;         // between the true and the written difference of two vertices [m]
};

struct FaceCheck {
  FaceCondition condition = FaceCondition::kFine;
  double off_plane = 0;  // largest distance of a vertex from the plane [m]; set if the face has area
  double diameter = 0;   // [m]
};

// Removes vertices that equal their predecessor, and spikes (a, b, a becomes a). Returns the number of
// removed vertices.
int RemoveRepeatedVertices(Polygon3& face);

// The condition of the face. If several conditions apply, the result is the first of: zero area, folded,
// self-crossing, uneven. A face may touch itself, for instance if a doubled edge joins a hole to the outline.
// A face is self-crossing if its winding number is neither 0 nor 1 (for a reversed face, -1) in some triangle
// that is wider than `tolerances.rounding`, of which no more than kMostRounding of the diameter counts. A
// face that is nowhere wider, and crosses itself, has no area. The result does not depend on the direction of
// the face or on its first vertex.
FaceCheck CheckFace(const Polygon3& face, const FaceTolerances& tolerances = {});

// The face itself if it is planar; otherwise triangles that fill it, whose vertices equal those of the face
// to the bit. A quadrilateral is cut along the diagonal that gives the better shaped triangles. A reversed
// face gives the same triangles, reversed. REQUIRES: CheckFace() returns kFine or kUneven.
std::vector<Polygon3> FlatPieces(const Polygon3& face);

}  // namespace penumbra
