#include "apps/points_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "apps/option_values.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

constexpr std::string_view kHeader = "x,y,z,nx,ny,nz";
constexpr std::array<const char*, 6> kColumns = {"x", "y", "z", "nx", "ny", "nz"};

[[noreturn]] void Fail(const std::string& path, std::size_t line, const std::string& what) {
  throw InputError(fmt::format("{}:{}: error: {}", path, line, what));
}

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

void CheckHeader(const std::string& path, std::size_t number, std::string_view line) {
  const std::vector<std::string_view> fields = SplitAtCommas(line);
  if (!std::equal(fields.begin(), fields.end(), kColumns.begin(), kColumns.end()))
    Fail(path, number, fmt::format("the header is '{}'; it must be '{}'", line, kHeader));
}

ProbePoint ReadRow(const std::string& path, std::size_t number, std::string_view line) {
  const std::vector<std::string_view> fields = SplitAtCommas(line);
  if (fields.size() != kColumns.size())
    Fail(path, number,
         fmt::format("{} values where the header names {}; give '{}'", fields.size(), kColumns.size(),
                     kHeader));
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<double> value = ParseNumber(fields[i]);
    if (!value)
      Fail(path, number,
           fmt::format("'{}' in column {} is not a finite number; write one, like -1.5e-3", fields[i],
                       kColumns[i]));
    values[i] = *value;
  }
  return {{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
}

std::string ReadFile(const std::string& path) {
  errno = 0;
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(path, ignored);
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && !folder && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (folder || !file.is_open() || file.bad() || text.fail())
    Fail(path, 0,
         fmt::format("cannot be read: {}; name a CSV file with the header '{}'",
                     folder ? "it is a directory" : std::strerror(errno != 0 ? errno : EIO), kHeader));
  return text.str();
}

}  // namespace

std::vector<ProbePoint> ReadPointsCsv(const std::string& path) {
  const std::string text = ReadFile(path);
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::string_view rest = text;
  if (rest.substr(0, kByteOrderMark.size()) == kByteOrderMark) rest.remove_prefix(kByteOrderMark.size());

  std::vector<ProbePoint> points;
  bool has_header = false;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = Trim(rest.substr(0, end));
    rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
    if (line.empty()) continue;
    if (has_header)
      points.push_back(ReadRow(path, number, line));
    else
      CheckHeader(path, number, line);
    has_header = true;
  }
  if (!has_header) Fail(path, 1, fmt::format("the file is empty; begin it with the header '{}'", kHeader));
  return points;
}

}  // namespace penumbra
