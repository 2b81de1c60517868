// solver/scene/contact_cuts.h
//
// Cuts patches along the walls that stand on them. Because an element has one radiosity, an element that
// extends below a wall would carry light from the lit side of the wall to the dark side.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// Replaces each patch on which walls stand by convex pieces, which cover the patch and keep its plane,
// material and faces. A *foot* on a patch is a segment along which another patch stands on the patch,
// intersects it, or hangs closely above it. A foot counts as a wall if both of the following conditions hold:
//
//  (1) The foot, a segment on the patch, is extended along its line in both directions up to the nearest
//      obstacle, which is the outline of the patch or another foot. Feet must cover at least three fifths of
//      the extended segment. Three fifths are enough so that a wall with a doorway still counts as a wall.
//      If feet cover less, the segment ends instead where other feet cross the foot: where thick walls cross
//      at the corner of a room, the end of a wall stands outside of the room.
//  (2) The foot, together with the feet that it touches, is not small compared with the diameter of the
//      patch, and the patch is not small compared with the largest reflecting patch of the scene.
//
// Feet of one convex solid are not obstacles for each other: a block on a floor covers the area that its feet
// enclose, and does not count as a wall unless it extends from wall to wall. Walls on a cut patch that cross
// each other are cut along each other, whatever their size, because they have parts in several rooms.
// REQUIRES: FindConvexSolids() has found the solids of the scene. CutAtWalls() also updates Scene::solids, so
// that the sides of the solids are the new pieces.
void CutAtWalls(Scene& scene);

}  // namespace penumbra
