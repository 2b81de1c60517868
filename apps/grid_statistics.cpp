#include "apps/grid_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// The lines of the table, and the keys of the JSON.
constexpr std::pair<const char*, double GridStatistics::*> kStatistics[] = {
    {"mean", &GridStatistics::mean},
    {"minimum", &GridStatistics::minimum},
    {"maximum", &GridStatistics::maximum},
    {"U0", &GridStatistics::overall_uniformity},
    {"Ud", &GridStatistics::diversity_uniformity}};

const char* UnitText(LightUnit unit) { return unit == LightUnit::kLux ? "lux" : "W/m^2"; }

bool HasUnit(double GridStatistics::*member) {
  return member != &GridStatistics::overall_uniformity && member != &GridStatistics::diversity_uniformity;
}

}  // namespace

GridStatistics StatisticsOf(std::span<const double> values) {
  PENUMBRA_CHECK(!values.empty());
  GridStatistics statistics;
  statistics.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  statistics.minimum = *low;
  statistics.maximum = *high;
  statistics.overall_uniformity = statistics.minimum / statistics.mean;
  statistics.diversity_uniformity = statistics.minimum / statistics.maximum;
  return statistics;
}

std::vector<std::vector<double>> LightColumns(const std::vector<Rgb>& light, LightUnit unit) {
  std::vector<std::vector<double>> columns(unit == LightUnit::kLux ? 1 : 3);
  for (const Rgb& value : light) {
    if (unit == LightUnit::kLux)
      columns[0].push_back(Lux(value));
    else
      for (std::size_t channel = 0; channel < 3; ++channel)
        columns[channel].push_back(value[static_cast<int>(channel)]);
  }
  return columns;
}

std::string StatisticsText(const std::vector<Rgb>& light, LightUnit unit, std::size_t left_out) {
  std::string text = fmt::format("{:<8} {}", "points", light.size());
  if (left_out > 0) text += fmt::format(", without {} inside solids or behind faces", left_out);
  text += '\n';
  if (light.empty()) return text;
  const std::vector<std::vector<double>> columns = LightColumns(light, unit);
  for (const auto& [name, member] : kStatistics) {
    text += fmt::format("{:<8}", name);
    for (const std::vector<double>& column : columns)
      text += fmt::format(" {:<10.5g}", StatisticsOf(column).*member);
    text += HasUnit(member) ? fmt::format(" {}\n", UnitText(unit)) : "\n";
  }
  return text;
}

nlohmann::ordered_json StatisticsJson(const std::vector<Rgb>& light, LightUnit unit, std::size_t left_out) {
  nlohmann::ordered_json json = {{"points", light.size()}, {"left_out", left_out}, {"unit", UnitText(unit)}};
  if (light.empty()) return json;
  const std::vector<std::vector<double>> columns = LightColumns(light, unit);
  for (const auto& [name, member] : kStatistics) {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (const std::vector<double>& column : columns) values.push_back(StatisticsOf(column).*member);
    json[name] = unit == LightUnit::kLux ? values[0] : values;
  }
  return json;
}

}  // namespace penumbra
