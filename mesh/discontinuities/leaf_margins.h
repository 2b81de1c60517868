// mesh/discontinuities/leaf_margins.h
//
// Distances, in units of SnapDistance(), that separate vertices in the interior of a quadtree leaf from the
// leaf's border. Because neighbouring quadtree leaves agree only on the vertices of their common border, no
// vertex in the interior of a leaf may lie so close to the leaf's border that rounding could place the vertex
// on the border.

#pragma once

namespace penumbra {

// A point whose distance from a line is at most kOnLine * SnapDistance() counts as a point of the line: two
// points within SnapDistance() of the line, on opposite sides, may be this far apart.
inline constexpr double kOnLine = 2;
// The smallest distance, in units of SnapDistance(), between a vertex inside a quadtree leaf and the leaf's
// border. kLeafMargin exceeds kOnLine because rounding bends a segment by up to SnapDistance().
inline constexpr double kLeafMargin = 4;
// A discontinuity counts as reaching the border of a quadtree leaf if the distance of its end from the
// border, measured along the discontinuity, is at most kLeafReach * SnapDistance(). If a segment nearly
// touches the border of a leaf, a part of at most kLeafReach * SnapDistance() of the segment is cut off.
inline constexpr double kLeafReach = 64;

}  // namespace penumbra
