// display/atlas/texture_charts.h
//
// The polygons of a scene on a picture (texture atlas): by the charts of this program, or by the texture
// coordinates that a modelling program has given to the faces.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "display/atlas/chart_layout.h"
#include "solver/scene/scene.h"

namespace penumbra {

// A planar polygon of the scene, and its place on a picture.
struct AtlasPolygon {
  Polygon3 corners;          // corners of the polygon [m], counter-clockwise seen from the front
  std::vector<Vec2> places;  // the picture coordinates of each corner [pixels], y downwards from the top
  // Triangles that fill the polygon, as indices of its corners, counter-clockwise seen from the front.
  std::vector<std::array<std::int32_t, 3>> triangles;
};

// The patches of a layout; polygon i is the patch of chart i.
std::vector<AtlasPolygon> PolygonsOfPatches(const Scene& scene, const ChartLayout& layout);
// The faces of a scene by their own texture coordinates (Face::uv) on a picture of size x size pixels;
// polygon i is the face i, empty for a dropped face or the back of another face. Throws InputError if a face
// has no texture coordinates, or texture coordinates outside of the picture.
std::vector<AtlasPolygon> PolygonsOfFaces(const Scene& scene, int size);

}  // namespace penumbra
