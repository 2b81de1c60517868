// mesh/discontinuities/leaf_margins.h
//
// Distances, in units of SnapDistance(), that separate the interior of a leaf from its border. Neighbouring
// leaves agree only on the vertices of their common border. No other vertex of a leaf may therefore lie so
// close to the border that rounding could place the vertex there.

#pragma once

namespace penumbra {

// The largest distance between two points that were snapped to one line, one from either side.
inline constexpr double kOnLine = 2;
// The smallest distance between a vertex inside a leaf and the leaf's border: kOnLine, and room for a segment
// that bends by 1.
inline constexpr double kLeafMargin = 4;
// A discontinuity that ends within this distance of a leaf's border, along its line, counts as reaching the
// border. This distance also bounds how much of a segment that nearly touches a border is cut off.
inline constexpr double kLeafReach = 64;

}  // namespace penumbra
