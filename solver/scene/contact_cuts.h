// solver/scene/contact_cuts.h
//
// Cuts patches along the walls that stand on them. An element has one radiosity; an element under a wall
// would carry light from the lit side of the wall to the dark side.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// Replaces each patch on which walls stand by convex pieces, which cover the patch and have its plane,
// material and faces. The *feet* on a patch are the segments along which other patches stand on it, intersect
// it, or hang closely above it. A foot is a wall if both of the following hold:
//
//  (1) Extend the foot along its line in both directions up to the nearest obstacle: the outline of the
//      patch, or another foot. Feet cover at least three fifths of the extended segment. A wall with a
//      doorway is therefore still a wall.
//  (2) The foot, together with the feet that it touches, is not small relative to the patch, and the patch is
//      not small relative to the largest patch of the scene.
//
// Feet of one convex solid are not obstacles for each other: a block on a floor covers the area that its feet
// enclose, and is no wall unless it extends from wall to wall. REQUIRES: the solids of the scene are known
// (FindConvexSolids). The function also updates Scene::solids, such that their sides are the new pieces.
void CutAtWalls(Scene& scene);

}  // namespace penumbra
