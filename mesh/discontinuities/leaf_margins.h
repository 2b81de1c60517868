// mesh/discontinuities/leaf_margins.h
//
// Distances, in units of SnapDistance(), that keep what lies inside a leaf apart from its border.
// Neighbouring leaves agree on the vertices of their common border only, so nothing inside one leaf may come
// so near to the border that rounding could place it there.

#pragma once

namespace penumbra {

// Two points that were snapped to one line lie within 2 of it, each from its own side.
inline constexpr double kOnLine = 2;
// Vertices inside a leaf keep this distance from its border: above kOnLine, with room for a segment that
// bends by 1.
inline constexpr double kLeafMargin = 4;
// A discontinuity that ends within this distance of a leaf's border, along its line, is taken to reach it. It
// bounds how far back a segment is cut that nearly touches a border.
inline constexpr double kLeafReach = 64;

}  // namespace penumbra
