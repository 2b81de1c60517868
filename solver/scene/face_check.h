// solver/scene/face_check.h
//
// Whether a face as given can be used, and what can be mended in it.

#pragma once

#include "solver/geometry/polygon.h"

namespace penumbra {

// A vertex may lie this far from its face's plane, relative to the face's diameter.
inline constexpr double kPlanarTolerance = 1e-6;

// A face this narrow, relative to its diameter, has no normal worth the name: the rounding of its coordinates
// turns it by more than 1e-4.
inline constexpr double kZeroWidth = 1e-12;

enum class FaceCondition { kFine, kZeroArea, kNotPlanar, kSelfCrossing };

// Removes vertices that repeat their predecessor, and spikes (a, b, a becomes a). Returns how many vertices
// went.
int RemoveRepeatedVertices(Polygon3& face);

// The face's condition, in the order: zero area, not planar, self-crossing. A face may touch itself, as one
// with a hole does that a doubled edge joins to the outline; it is self-crossing if it winds around some
// point other than once.
FaceCondition CheckFace(const Polygon3& face);

}  // namespace penumbra
