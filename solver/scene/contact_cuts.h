// solver/scene/contact_cuts.h
//
// Cuts patches along the walls that stand on them. An element has one radiosity: one that lies under a wall
// would carry light from the lit side to the dark one.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// Replaces each patch that walls stand on by convex pieces, which lie in its place and have its plane,
// material and faces. What stands on a patch, crosses it, or hangs closely above it is a wall there
//
//  (1) if it and what goes on in its line cover at least three fifths of the line from what stops it on one
//  side (the
//      patch's outline, or another foot) to what stops it on the other, so that a doorway does not make it
//      less of a wall;
//  (2) if it is not small beside the patch, together with what it touches, nor the patch beside the scene's
//  largest.
//
// The feet of one convex solid do not stop each other: a block on a floor covers what they enclose, and is no
// wall unless it reaches from wall to wall. REQUIRES: the scene's solids are known (FindConvexSolids);
// afterwards they are those of the pieces.
void CutAtWalls(Scene& scene);

}  // namespace penumbra
