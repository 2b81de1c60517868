// solver/scene/face_check.h
//
// Whether a face as given can be used, and what can be mended in it. All takes time n log n of its vertices.

#pragma once

#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// A vertex may lie this far from its face's plane, relative to the face's diameter, and
inline constexpr double kPlanarTolerance = 1e-6;
// so far if the face is cut: surveyed walls and faces of few decimals stay below, and what is farther off was
// not meant to be flat.
inline constexpr double kCutTolerance = 0.05;

// A face this narrow, relative to its diameter, has no normal worth the name: the rounding of its coordinates
// turns it by more than 1e-4.
inline constexpr double kZeroWidth = 1e-12;

enum class FaceCondition {
  kFine,
  kZeroArea,
  kUneven,  // off its plane by more than kPlanarTolerance, but not kCutTolerance: FlatPieces() cuts it
  kFolded,  // farther off
  kSelfCrossing
};

struct FaceCheck {
  FaceCondition condition = FaceCondition::kFine;
  double off_plane = 0;  // the largest distance of a vertex from the plane [m]; of faces with area
  double diameter = 0;   // [m]
};

// Removes vertices that repeat their predecessor, and spikes (a, b, a becomes a). Returns how many vertices
// went.
int RemoveRepeatedVertices(Polygon3& face);

// The face's condition, in the order: zero area, folded, self-crossing, uneven. A face may touch itself, as
// one with a hole does that a doubled edge joins to the outline; it is self-crossing if it winds around some
// point other than once. It is the same for the face reversed or begun at another vertex.
FaceCheck CheckFace(const Polygon3& face);

// The face itself if it is planar, else triangles that fill it, with its vertices to the bit: a quadrilateral
// is cut along the diagonal that leaves the better shaped triangles. A reversed face has the same triangles,
// reversed. REQUIRES: the face is fine or uneven.
std::vector<Polygon3> FlatPieces(const Polygon3& face);

}  // namespace penumbra
