// solver/transport/solvers/congruent_pairs.h
//
// Which pairs of polygons look alike: on even meshes most do, and one form factor serves them all.

#pragma once

#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The squared distances among the vertices of two convex polygons, in an order that neither depends on which
// polygon is first nor on where their vertices begin or which way they run [m^2]. Equal shapes have the same
// flux between them, but for rounding of the coordinates, where nothing blocks: they are images of each other
// by a rigid motion or a reflection. Empty for polygons that are not wholly before each other's planes: their
// distances do not tell on which side their fronts are.
using PairShape = std::vector<double>;
PairShape ShapeOfPair(std::span<const Vec3> a, const Patch& patch_a, std::span<const Vec3> b,
                      const Patch& patch_b);

}  // namespace penumbra
