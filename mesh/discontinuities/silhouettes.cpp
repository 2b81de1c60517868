#include "mesh/discontinuities/silhouettes.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace penumbra {

Silhouettes::Silhouettes(const Scene& scene)
    : scene_(scene), corner_at_(4 * scene.patches.size(), -1), edge_at_(4 * scene.patches.size(), -1) {
  std::map<std::tuple<double, double, double>, std::int32_t> corner;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> edge;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const Patch& patch = scene.patches[p];
    const auto id = static_cast<PatchId>(p);
    for (std::int32_t k = 0; k < patch.size; ++k) {
      const Vec3& v = patch.vertex[k];
      // Adding 0 turns -0 into 0.
      const auto [place, added] = corner.try_emplace(std::tuple(v.x() + 0.0, v.y() + 0.0, v.z() + 0.0),
                                                     static_cast<std::int32_t>(corners_.size()));
      if (added) corners_.push_back({v, {}, {}});
      corner_at_[Index(id, k)] = place->second;
      corners_[Size(place->second)].patches.push_back(id);
    }
    for (std::int32_t k = 0; k < patch.size; ++k) {
      const std::int32_t a = CornerAt(id, k), b = CornerAt(id, (k + 1) % patch.size);
      const auto [place, added] =
          edge.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(edges_.size()));
      if (added) {
        edges_.push_back({a, b, {}});
        corners_[Size(a)].edges.push_back(place->second);
        corners_[Size(b)].edges.push_back(place->second);
      }
      edge_at_[Index(id, k)] = place->second;
      edges_[Size(place->second)].sharing.push_back({id, k});
    }
  }
}

Vec3 Silhouettes::Away(std::int32_t edge, std::int32_t corner) const {
  const Edge& e = edges_[Size(edge)];
  return Position(e.a == corner ? e.b : e.a) - Position(corner);
}

std::array<double, 2> Silhouettes::Sides(std::int32_t edge, const Vec3& from) const {
  const std::span<const PatchEdge> sharing = Sharing(edge);
  if (sharing.size() != 2 || sharing[0].patch == sharing[1].patch) return {0, 0};
  const Patch &one = scene_.patches[sharing[0].patch], &two = scene_.patches[sharing[1].patch];
  const Vec3& a = one.vertex[sharing[0].k];
  // The faces of a closed surface traverse their common edge in opposite directions; otherwise one face is
  // reversed.
  const double turned = two.vertex[sharing[1].k] == a ? -1 : 1;
  return {one.normal.dot(from - a), turned * two.normal.dot(from - a)};
}

bool Silhouettes::IsSilhouette(std::int32_t edge, const Vec3& from) const {
  const auto [one, two] = Sides(edge, from);
  return one * two <= 0;
}

bool Silhouettes::MayBeSilhouette(std::int32_t edge, std::span<const Vec3> polygon) const {
  bool front = true, back = true;  // for both faces
  for (const Vec3& p : polygon) {
    const auto [one, two] = Sides(edge, p);
    front = front && std::min(one, two) > 0;
    back = back && std::max(one, two) < 0;
  }
  return !front && !back;
}

}  // namespace penumbra
