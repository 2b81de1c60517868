// mesh/discontinuities/leaf_margins.h
//
// Distances, in units of SnapDistance(), that separate vertices in the interior of a quadtree leaf from the
// leaf's border. Neighbouring quadtree leaves agree only on the vertices of their common border. No vertex in
// the interior of a leaf may therefore lie so close to the leaf's border that rounding could place the vertex
// on the border.

#pragma once

namespace penumbra {

// The largest distance, in units of SnapDistance(), between two points that were snapped to the same line,
// one from each side of the line.
inline constexpr double kOnLine = 2;
// The smallest distance between a vertex inside a leaf and the leaf's border: kOnLine, plus room for a
// segment that snapping bends by one SnapDistance().
inline constexpr double kLeafMargin = 4;
// A discontinuity counts as reaching the border of a quadtree leaf if the distance of its end from the
// border, measured along the discontinuity, is at most kLeafReach * SnapDistance(). If a segment nearly
// touches the border of a leaf, a part of at most kLeafReach * SnapDistance() of the segment is cut off.
inline constexpr double kLeafReach = 64;

}  // namespace penumbra
