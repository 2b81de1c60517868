// solver/transport/solvers/congruent_pairs.h
//
// Finds congruent pairs of polygons. Regular meshes have many congruent pairs, and without blockers all pairs
// of the same shape have the same form factor.

#pragma once

#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The squared distances between the vertices of two convex polygons [m^2], in an order that depends neither
// on the order of the two polygons nor on their first vertices or orientations. Pairs of polygons with equal
// PairShape are images of each other under a rigid motion or a reflection. Without blockers, pairs of
// polygons with equal PairShape exchange the same flux, up to rounding of the coordinates. The list of
// distances is empty if one polygon does not lie completely in front of the plane of the other, because
// distances alone do not distinguish front from back.
using PairShape = std::vector<double>;
PairShape ShapeOfPair(std::span<const Vec3> a, const Patch& patch_a, std::span<const Vec3> b,
                      const Patch& patch_b);

}  // namespace penumbra
