// mesh/discontinuities/leaf_margins.h
//
// Distances, in units of SnapDistance(), that separate the interior of a leaf from its border. Neighbouring
// leaves agree only on the vertices of their common border. No other vertex of a leaf may therefore lie so
// close to the border that rounding could place the vertex there.

#pragma once

namespace penumbra {

// The largest distance between two points that were snapped to the same line, one from each side of the line.
inline constexpr double kOnLine = 2;
// The smallest distance between a vertex inside a leaf and the leaf's border: kOnLine plus room for a segment
// that snapping bends by 1.
inline constexpr double kLeafMargin = 4;
// A discontinuity counts as reaching the border of a leaf if the distance of its end from the border,
// measured along its line, is at most kLeafReach. If a segment nearly touches a border, at most the length
// kLeafReach of the segment is cut off.
inline constexpr double kLeafReach = 64;

}  // namespace penumbra
