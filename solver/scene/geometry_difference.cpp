#include "solver/scene/geometry_difference.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra {

std::optional<std::string> GeometryDifference(const Scene& one, const Scene& other) {
  if (one.faces.size() != other.faces.size())
    return fmt::format("{} faces against {}", one.faces.size(), other.faces.size());
  for (std::size_t f = 0; f < one.faces.size(); ++f)
    if (one.faces[f].vertices != other.faces[f].vertices)
      return fmt::format("face {} (counted from 0) has other vertices", f);
  // Emitters win where faces overlap, and only faces of one material are merged.
  const char* const kCutOtherwise =
      "the faces are the same, but overlap or merge in another way with these materials";
  if (one.patches.size() != other.patches.size()) return kCutOtherwise;
  for (std::size_t p = 0; p < one.patches.size(); ++p) {
    const Patch &a = one.patches[p], &b = other.patches[p];
    if (a.faces != b.faces || !std::ranges::equal(a.Vertices(), b.Vertices())) return kCutOtherwise;
  }
  return std::nullopt;
}

}  // namespace penumbra
