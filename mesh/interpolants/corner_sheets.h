// mesh/interpolants/corner_sheets.h
//
// The corners of triangles that share a vertex and lie on the same side of all discontinuities of the mesh
// form a sheet. Light is continuous over a sheet.

#pragma once

#include <cstddef>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"

namespace penumbra {

class CornerSheets {
 public:
  // Sheets of a mesh; its light is not used.
  explicit CornerSheets(const IrradianceMesh& mesh);

  // The number of corner k of triangle t.
  static std::size_t Corner(std::size_t t, std::size_t k) { return 3 * t + k; }
  // A number for each sheet: below the number of corners, and equal for the corners of a sheet.
  std::size_t Of(std::size_t corner) const { return sheet_[corner]; }
  std::size_t size() const { return sheet_.size(); }

  // A sheet is straight if its angles add up to pi: its vertex lies within a straight border of a patch, or
  // within a straight discontinuity.
  bool IsStraight(std::size_t sheet) const { return !into_[sheet].isZero(0); }
  // For a straight sheet, the direction from its vertex into the sheet, perpendicular to the border of the
  // sheet. The direction is the same for every triangulation. For other sheets, the zero vector.
  const Vec3& Into(std::size_t sheet) const { return into_[sheet]; }

 private:
  std::vector<std::size_t> sheet_;  // by corner
  std::vector<Vec3> into_;          // by sheet
};

}  // namespace penumbra
