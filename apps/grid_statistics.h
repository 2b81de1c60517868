// apps/grid_statistics.h
//
// The statistics of the light at grid points that the command `penumbra grid` reports.

#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "display/photometry.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// The statistics of a quantity, such as illuminance, over all grid points. U0 = minimum / mean and Ud =
// minimum / maximum are the uniformities of lighting standards (EN 12464-1). U0 and Ud are nan if all values
// are 0.
struct GridStatistics {
  double mean = 0, minimum = 0, maximum = 0;
  double overall_uniformity = 0;    // U0 = (minimum of the irradiance over the grid) / (mean)
  double diversity_uniformity = 0;  // Ud = (minimum of the irradiance over the grid) / (maximum)
};

// Computes mean, minimum, maximum and uniformities. REQUIRES: `values` is not empty.
GridStatistics StatisticsOf(std::span<const double> values);

// Converts the light at all points to columns of numbers: one column in lux, or three columns for red, green
// and blue in W/m^2.
std::vector<std::vector<double>> LightColumns(const std::vector<Rgb>& light, LightUnit unit);

// StatisticsText() returns the statistics of the light as a table, StatisticsJson() as JSON. The values in
// JSON are numbers in lux or lists of three numbers in W/m^2. `left_out` is the number of points that no
// light can reach.
std::string StatisticsText(const std::vector<Rgb>& light, LightUnit unit, std::size_t left_out);
nlohmann::ordered_json StatisticsJson(const std::vector<Rgb>& light, LightUnit unit, std::size_t left_out);

}  // namespace penumbra
