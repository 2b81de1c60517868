// solver/base/similar_names.h
//
// Finds the names that a user who misspelt a name may have meant.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

// The edit distance of two texts: the least number of letters that must be inserted, removed or replaced to
// turn one text into the other.
std::size_t EditDistance(std::string_view a, std::string_view b);

// Returns the given names, sorted by their edit distance from `name`; names at equal distance keep their
// order.
std::vector<std::string> NearestFirst(std::string_view name, std::vector<std::string> names);

// Returns the text "; did you mean 'X'?", where X is the most similar of the names; an empty text if no name
// is similar. The comparison of names treats capital and small letters as equal.
std::string DidYouMean(std::string_view name, const std::vector<std::string>& names);

}  // namespace penumbra
