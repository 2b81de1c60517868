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

// A convex part of a patch that is drawn. It hides what lies behind it from both sides.
struct DrawnPolygon {
  PatchId patch = kNoPatch;
  std::span<const Vec3> vertices;  // [m], in the patch's plane
  std::int32_t target = -1;        // where its cells count, if its front is seen; -1: it only hides
};

// Where the point stands: its patch, which it does not see, and the axes of its frame, with z along the
// normal.
struct Eye {
  PatchId own = kNoPatch;
  Vec3 position = Vec3::Zero();  // [m]
  Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
};

class ItemBuffer {
 public:
  // Draws the polygons; those whose plane contains the eye are invisible. Of two polygons in one cell the
  // nearer wins, where the ray through the cell's sample point meets their planes. Of two in the plane of one
  // patch, a target wins. The grid must outlive the object.
  ItemBuffer(const PlaneGrid& grid, const Scene& scene, const Eye& eye,
             std::span<const DrawnPolygon> polygons);

  // Adds `weight` * (form factor of each cell) to the factor of the target that is seen in the cell.
  void AddFactors(double weight, std::span<double> factors) const;

 private:
  struct Cell {
    double distance = 0;  // to the plane, in units of the ray's length to the cell; 0: nothing is seen
    PatchId patch = kNoPatch;
    std::int32_t target = -1;
  };
  struct Plane;

  void Draw(const Scene& scene, const Eye& eye, const DrawnPolygon& polygon);
  void FillRow(const Plane& plane, std::span<const Vec2> outline, int row);
  void Put(const Plane& plane, int column, int row, const Vec2& sample);

  const PlaneGrid& grid_;
  std::vector<Cell> cells_;
  std::vector<Vec3> view_, clipped_;  // reused from polygon to polygon
  std::vector<Vec2> outline_;
};

}  // namespace penumbra
