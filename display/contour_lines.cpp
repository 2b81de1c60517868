#include "display/contour_lines.h"

#include <cmath>

namespace penumbra {
namespace {

// The crossings of the level with the sides of the square whose lowest corner is (column, row), in the order
// of the sides: below, right, above, left.
std::vector<Vec2> CrossingsOf(const std::array<double, 4>& corner, int column, int row, double level) {
  const std::array<Vec2, 4> place = {Vec2(column, row), Vec2(column + 1, row), Vec2(column + 1, row + 1),
                                     Vec2(column, row + 1)};
  std::vector<Vec2> crossings;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    if ((corner[i] >= level) == (corner[j] >= level)) continue;
    const double t = (level - corner[i]) / (corner[j] - corner[i]);
    crossings.push_back(place[i] + t * (place[j] - place[i]));
  }
  return crossings;
}

}  // namespace

std::vector<std::array<Vec2, 2>> ContourLines(const ValueGrid& grid, double level) {
  std::vector<std::array<Vec2, 2>> lines;
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const std::array<double, 4> corner = {grid.At(column, row), grid.At(column + 1, row),
                                            grid.At(column + 1, row + 1), grid.At(column, row + 1)};
      const double sum = corner[0] + corner[1] + corner[2] + corner[3];
      if (std::isnan(sum)) continue;
      const std::vector<Vec2> at = CrossingsOf(corner, column, row, level);
      if (at.size() == 2) lines.push_back({at[0], at[1]});
      if (at.size() == 4) {
        // The first corner is cut off if the middle is on the other side of the level.
        const bool cut = (corner[0] >= level) != (sum / 4 >= level);
        lines.push_back(cut ? std::array{at[3], at[0]} : std::array{at[0], at[1]});
        lines.push_back(cut ? std::array{at[1], at[2]} : std::array{at[2], at[3]});
      }
    }
  return lines;
}

}  // namespace penumbra
