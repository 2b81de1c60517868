#include "apps/points_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "solver/base/read_file.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

constexpr std::string_view kHeader = "x,y,z,nx,ny,nz", kShortHeader = "x,y,z";
constexpr std::size_t kPositionColumns = 3;
constexpr std::array<const char*, 6> kColumns = {"x", "y", "z", "nx", "ny", "nz"};

std::string_view Trim(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> SplitAtCommas(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(Trim(line.substr(0, comma)));
    if (comma == line.npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

// The number of columns that the header names.
std::size_t ReadHeader(const std::string& path, int number, std::string_view line) {
  const std::vector<std::string_view> fields = SplitAtCommas(line);
  const bool is_known = (fields.size() == kColumns.size() || fields.size() == kPositionColumns) &&
                        std::equal(fields.begin(), fields.end(), kColumns.begin());
  if (!is_known)
    throw ErrorAt(path, number,
                  fmt::format("the header is {}; it must be '{}', or '{}' for points on faces", Quoted(line),
                              kHeader, kShortHeader));
  return fields.size();
}

ProbePoint ReadRow(const std::string& path, int number, std::string_view line, std::size_t columns) {
  const std::vector<std::string_view> fields = SplitAtCommas(line);
  if (fields.size() != columns && fields.size() != kPositionColumns)
    throw ErrorAt(path, number,
                  fmt::format("{} values where the header names {}; give '{}'", fields.size(), columns,
                              columns == kPositionColumns ? kShortHeader : kHeader));
  std::array<double, 6> values{};
  const bool has_normal =
      std::any_of(fields.begin() + kPositionColumns, fields.end(), [](auto field) { return !field.empty(); });
  for (std::size_t i = 0; i < (has_normal ? columns : kPositionColumns); ++i) {
    const std::optional<double> value = ToNumber(fields[i]);
    if (!value || !std::isfinite(*value))
      throw ErrorAt(path, number,
                    fmt::format("{} in column {} is not a finite number; write one, like -1.5e-3",
                                Quoted(fields[i]), kColumns[i]));
    values[i] = *value;
  }
  return {{values[0], values[1], values[2]}, {values[3], values[4], values[5]}, has_normal, number};
}

}  // namespace

std::string NameOfPoints(const std::string& path) {
  return path == kPointsFromInput ? "standard input" : path;
}

std::vector<ProbePoint> ReadPointsCsv(const std::string& path) {
  const std::string name = NameOfPoints(path);
  std::string text;
  try {
    text = path == kPointsFromInput ? ReadStandardInput() : ReadFileBytes(path);
  } catch (const ReadFailure& failure) {
    throw ErrorAt(name, 0, fmt::format("{}; name a CSV file with the header '{}'", failure.what(), kHeader));
  }
  return ReadPointsText(text, name);
}

std::vector<ProbePoint> ReadPointsText(std::string_view text, const std::string& path) {
  RefuseForeignFormat(text, path, fmt::format("a CSV file with the header '{}'", kHeader));
  std::vector<ProbePoint> points;
  std::size_t columns = 0;  // 0: the header has not come yet
  for (LineReader lines(text); !lines.AtEnd();) {
    const int number = lines.NextLine();
    const std::string_view line = Trim(lines.Take());
    if (line.empty()) continue;
    if (columns > 0)
      points.push_back(ReadRow(path, number, line, columns));
    else
      columns = ReadHeader(path, number, line);
  }
  if (columns == 0)
    throw ErrorAt(path, 1, fmt::format("the file is empty; begin it with the header '{}'", kHeader));
  return points;
}

}  // namespace penumbra
