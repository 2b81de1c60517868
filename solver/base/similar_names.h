// solver/base/similar_names.h
//
// Finds what a user who misspelt a name may have meant.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

// The least number of letters that must be inserted, removed or replaced to turn one text into the other.
std::size_t EditDistance(std::string_view a, std::string_view b);

// The names, sorted by their edit distance from `name`; equally distant names keep their order.
std::vector<std::string> NearestFirst(std::string_view name, std::vector<std::string> names);

// "; did you mean 'X'?", where X is the nearest of the names; empty if no name is near. Capital and small
// letters count as equal.
std::string DidYouMean(std::string_view name, const std::vector<std::string>& names);

}  // namespace penumbra
