#include "solver/base/similar_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace penumbra {
namespace {

// Longer names are compared by their beginning, so that no comparison takes long.
constexpr std::size_t kLongestName = 100;

// A misspelt name differs from the meant one in at most one letter of three.
constexpr std::size_t kLettersPerMistake = 3;

std::string InSmallLetters(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

}  // namespace

std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::vector<std::string> NearestFirst(std::string_view name, std::vector<std::string> names) {
  name = name.substr(0, kLongestName);
  std::vector<std::pair<std::size_t, std::string>> found;
  for (std::string& other : names) {
    const std::size_t distance = EditDistance(name, std::string_view(other).substr(0, kLongestName));
    found.emplace_back(distance, std::move(other));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  names.clear();
  for (auto& [distance, other] : found) names.push_back(std::move(other));
  return names;
}

std::string DidYouMean(std::string_view name, const std::vector<std::string>& names) {
  const std::string small = InSmallLetters(name.substr(0, kLongestName));
  std::size_t least = (small.size() + kLettersPerMistake - 1) / kLettersPerMistake + 1;
  const std::string* nearest = nullptr;
  for (const std::string& other : names) {
    const std::size_t distance =
        EditDistance(small, InSmallLetters(std::string_view(other).substr(0, kLongestName)));
    if (distance >= least) continue;
    least = distance;
    nearest = &other;
  }
  return nearest ? "; did you mean '" + *nearest + "'?" : "";
}

}  // namespace penumbra
