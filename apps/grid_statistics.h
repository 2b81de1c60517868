// apps/grid_statistics.h
//
// What `penumbra grid` tells of the light at its points.

#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "display/photometry.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// Of one value at all points: U0 = minimum / mean and Ud = minimum / maximum are the uniformities of lighting
// standards (EN 12464-1). They are nan where all is dark.
struct GridStatistics {
  double mean = 0, minimum = 0, maximum = 0;
  double overall_uniformity = 0;    // U0
  double diversity_uniformity = 0;  // Ud
};

// REQUIRES: there is a value.
GridStatistics StatisticsOf(std::span<const double> values);

// The columns of the light in a unit: one of lux, or red, green and blue in W/m^2.
std::vector<std::vector<double>> LightColumns(const std::vector<Rgb>& light, LightUnit unit);

// The statistics of all columns as a table, and as JSON: numbers in lux, lists of three in W/m^2. `left_out`
// is the number of points that no light can reach.
std::string StatisticsText(const std::vector<Rgb>& light, LightUnit unit, std::size_t left_out);
nlohmann::ordered_json StatisticsJson(const std::vector<Rgb>& light, LightUnit unit, std::size_t left_out);

}  // namespace penumbra
