// solver/transport/form_factors/item_buffer.h
//
// A rasteriser that finds which polygon a point sees through each cell of a plane, with a depth buffer (Cohen
// and Greenberg 1985).

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/transport/form_factors/plane_grid.h"

namespace penumbra {

// A convex part of a patch (planar polygon of the scene) that is drawn into the item buffer. A drawn polygon
// hides all that lies behind it, even if the eye sees the polygon's back.
struct DrawnPolygon {
  PatchId patch = kNoPatch;
  std::span<const Vec3> vertices;  // vertices of the polygon [m], in the plane of its patch
  // Index of the form factor to which the form factors of those cells are added that show the polygon's
  // front; -1 if the polygon only hides other polygons.
  std::int32_t target = -1;
};

// The point from which the form factors are computed, with the axes of its frame; z is the surface normal.
struct Eye {
  PatchId own = kNoPatch;
  Vec3 position = Vec3::Zero();  // position of the eye [m]
  Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
};

class ItemBuffer {
 public:
  // Draws the polygons into the cells of the grid; polygons whose plane contains the eye are invisible. If
  // two polygons cover a cell's sample point, the ItemBuffer stores the polygon that is nearer to the eye,
  // along the ray through the sample point. If two polygons of the same patch cover a cell's sample point,
  // the ItemBuffer stores the polygon with a target index (target >= 0). The grid must outlive the
  // ItemBuffer.
  ItemBuffer(const PlaneGrid& grid, const Scene& scene, const Eye& eye,
             std::span<const DrawnPolygon> polygons);

  // For each cell in which a target is visible, adds `weight` * (form factor of the cell) to factors[target].
  void AddFactors(double weight, std::span<double> factors) const;

 private:
  struct Cell {
    // (distance from the eye to the polygon) / (distance from the eye to the cell), along the ray through the
    // cell's sample point; 0 if the cell shows no polygon
    double distance = 0;
    PatchId patch = kNoPatch;
    std::int32_t target = -1;
  };
  struct Plane;

  void Draw(const Scene& scene, const Eye& eye, const DrawnPolygon& polygon);
  void FillRow(const Plane& plane, std::span<const Vec2> outline, int row);
  void Put(const Plane& plane, int column, int row, const Vec2& sample);

  const PlaneGrid& grid_;
  std::vector<Cell> cells_;
  std::vector<Vec3> view_, clipped_;  // buffers that are reused from polygon to polygon
  std::vector<Vec2> outline_;
};

}  // namespace penumbra
