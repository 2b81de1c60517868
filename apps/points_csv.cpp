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

constexpr std::string_view kHeader = "x,y,z,nx,ny,nz";
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

void CheckHeader(const std::string& path, int number, std::string_view line) {
  const std::vector<std::string_view> fields = SplitAtCommas(line);
  if (!std::equal(fields.begin(), fields.end(), kColumns.begin(), kColumns.end()))
    throw ErrorAt(path, number, fmt::format("the header is {}; it must be '{}'", Quoted(line), kHeader));
}

ProbePoint ReadRow(const std::string& path, int number, std::string_view line) {
  const std::vector<std::string_view> fields = SplitAtCommas(line);
  if (fields.size() != kColumns.size())
    throw ErrorAt(path, number,
                  fmt::format("{} values where the header names {}; give '{}'", fields.size(),
                              kColumns.size(), kHeader));
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<double> value = ToNumber(fields[i]);
    if (!value || !std::isfinite(*value))
      throw ErrorAt(path, number,
                    fmt::format("{} in column {} is not a finite number; write one, like -1.5e-3",
                                Quoted(fields[i]), kColumns[i]));
    values[i] = *value;
  }
  return {{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
}

}  // namespace

std::vector<ProbePoint> ReadPointsCsv(const std::string& path) {
  std::string text;
  try {
    text = ReadFileBytes(path);
  } catch (const ReadFailure& failure) {
    throw ErrorAt(path, 0, fmt::format("{}; name a CSV file with the header '{}'", failure.what(), kHeader));
  }
  return ReadPointsText(text, path);
}

std::vector<ProbePoint> ReadPointsText(std::string_view text, const std::string& path) {
  RefuseForeignFormat(text, path, fmt::format("a CSV file with the header '{}'", kHeader));
  std::vector<ProbePoint> points;
  bool has_header = false;
  for (LineReader lines(text); !lines.AtEnd();) {
    const int number = lines.NextLine();
    const std::string_view line = Trim(lines.Take());
    if (line.empty()) continue;
    if (has_header)
      points.push_back(ReadRow(path, number, line));
    else
      CheckHeader(path, number, line);
    has_header = true;
  }
  if (!has_header)
    throw ErrorAt(path, 1, fmt::format("the file is empty; begin it with the header '{}'", kHeader));
  return points;
}

}  // namespace penumbra
