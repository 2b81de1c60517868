// mesh/interpolants/corner_sheets.h
//
// A sheet is a set of triangle corners that share a vertex of the mesh and lie on the same side of all
// discontinuities of the mesh. Irradiance is continuous across the triangle corners that form a sheet.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

// The triangles that are no flatter than rounding makes them: where the lines of a mesh miss each other by a
// rounding error, a triangle fills the gap. From within such a flat triangle it cannot be told on which side
// of the lines its vertices lie.
class FlatTriangles {
 public:
  // Triangles of patch p are flat if the height above their longest edge is at most widths[p] [m].
  FlatTriangles(const IrradianceMesh& mesh, std::span<const double> widths);

  bool Contains(std::size_t t) const { return beside_[t] != t; }
  // The triangle itself; for a flat one, the nearest triangle that is not flat, on the same side of all
  // discontinuities if there is one. A flat triangle of which all neighbours are flat stands for itself.
  std::size_t Beside(std::size_t t) const { return beside_[t]; }

 private:
  std::vector<std::size_t> beside_;
};

class CornerSheets {
 public:
  // Finds the sheets (sets of triangle corners with continuous irradiance) of a mesh. The constructor does
  // not use the interpolants of the mesh. `flat` may be null if the mesh has no flat triangle.
  explicit CornerSheets(const IrradianceMesh& mesh, const FlatTriangles* flat = nullptr);

  // The index of corner k of triangle t among the corners of all triangles.
  static std::size_t Corner(std::size_t t, std::size_t k) { return 3 * t + k; }
  // Returns the number of the sheet (set of corners with continuous irradiance) that contains the triangle
  // corner. Numbers of sheets are smaller than the number of all triangle corners.
  std::size_t Of(std::size_t corner) const { return sheet_[corner]; }
  std::size_t size() const { return sheet_.size(); }

  // A sheet is straight if the angles of its triangle corners add up to pi: the vertex of the corners then
  // lies within a straight border of a patch, or within a straight discontinuity. A vertex of a flat triangle
  // has no straight sheet, because rounding may separate this vertex from a corner of the patch or from the
  // end of a contact, which the angles at the vertex then do not show.
  bool IsStraight(std::size_t sheet) const { return !into_[sheet].isZero(0); }
  // For a straight sheet, whose triangles lie on one side of a straight line, Into() is the direction from
  // the line into these triangles, perpendicular to the line. The direction Into() does not depend on how the
  // patch is triangulated. For a sheet that is not straight, Into() is the zero vector.
  const Vec3& Into(std::size_t sheet) const { return into_[sheet]; }

 private:
  // sheet_[c] is the number of the sheet (triangles on one side of a contact) of triangle corner c.
  std::vector<std::size_t> sheet_;
  std::vector<Vec3> into_;  // into_[k] is the direction that Into(k) returns
};

}  // namespace penumbra
