#include "solver/scene/scene_parts.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "solver/base/size.h"

namespace penumbra {
namespace {

bool Reflects(const Scene& scene, PatchId patch) { return (scene.MaterialOf(patch).reflectance > 0).any(); }

bool AnyReflects(const Scene& scene) {
  for (PatchId p = 0; p < Size(scene.patches); ++p)
    if (Reflects(scene, p)) return true;
  return false;
}

// Of each patch the number of its group: patches that share vertices are in one, whatever lies between.
std::vector<std::int32_t> GroupsByVertices(const Scene& scene) {
  std::vector<std::int32_t> parent(scene.patches.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](std::int32_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  std::map<std::array<double, 3>, PatchId> first;
  std::map<std::int32_t, PatchId> first_of_face;  // pieces of a face hang together, too
  for (PatchId p = 0; p < Size(scene.patches); ++p) {
    const auto join = [&](PatchId other) {
      parent[std::max(find(p), find(other))] = std::min(find(p), find(other));
    };
    for (const Vec3& v : scene.patches[p].Vertices())
      join(first.try_emplace({v.x(), v.y(), v.z()}, p).first->second);
    for (const std::int32_t face : scene.patches[p].faces)
      join(first_of_face.try_emplace(face, p).first->second);
  }
  std::vector<std::int32_t> group;
  for (PatchId p = 0; p < Size(scene.patches); ++p) group.push_back(find(p));
  return group;
}

// "face 3", "faces 3 to 8", "faces 3 to 20, 12 of them".
std::string NameByFaces(const Scene& scene, std::span<const PatchId> patches) {
  std::vector<std::int32_t> faces;
  for (const PatchId p : patches)
    faces.insert(faces.end(), scene.patches[p].faces.begin(), scene.patches[p].faces.end());
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  if (faces.size() == 1) return fmt::format("face {}", faces[0]);
  std::string name = fmt::format("faces {} to {}", faces.front(), faces.back());
  if (faces.back() - faces.front() >= Size(faces)) name += fmt::format(", {} of them", faces.size());
  return name;
}

}  // namespace

std::vector<double> ReflectingAreas(const Scene& scene) {
  const bool any = AnyReflects(scene);
  std::vector<double> areas;
  for (PatchId p = 0; p < Size(scene.patches); ++p)
    areas.push_back(!any || Reflects(scene, p) ? scene.patches[p].area : 0.0);
  return areas;
}

std::vector<std::array<bool, 3>> ReflectingChannels(const Scene& scene) {
  const bool any = AnyReflects(scene);
  std::vector<std::array<bool, 3>> channels;
  for (PatchId p = 0; p < Size(scene.patches); ++p) {
    const Rgb& reflectance = scene.MaterialOf(p).reflectance;
    channels.push_back({!any || reflectance[0] > 0, !any || reflectance[1] > 0, !any || reflectance[2] > 0});
  }
  return channels;
}

std::vector<ScenePart> PartsOf(const Scene& scene) {
  std::vector<std::int32_t> group;
  for (const Patch& patch : scene.patches) group.push_back(patch.object);
  const bool named = std::any_of(group.begin(), group.end(), [&](std::int32_t g) { return g != group[0]; });
  if (!named) group = GroupsByVertices(scene);
  std::map<std::int32_t, std::size_t> number;
  std::vector<ScenePart> parts;
  for (PatchId p = 0; p < Size(scene.patches); ++p) {
    const auto [place, is_new] = number.try_emplace(group[p], parts.size());
    if (is_new) parts.emplace_back();
    parts[place->second].patches.push_back(p);
  }
  for (ScenePart& part : parts)
    part.name =
        named ? scene.objects[scene.patches[part.patches[0]].object].name : NameByFaces(scene, part.patches);
  return parts;
}

}  // namespace penumbra
