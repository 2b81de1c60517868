#include "solver/scene/emitters.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "solver/base/check.h"
#include "solver/base/similar_names.h"

namespace penumbra {
namespace {

bool Emits(const Scene& scene, std::size_t patch) {
  return (scene.MaterialOf(static_cast<PatchId>(patch)).emittance > 0).any();
}

// The smallest index of a set of numbers that are joined pairwise.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t Find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::size_t a, std::size_t b) {
    a = Find(a);
    b = Find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

constexpr std::string_view kObjectPrefix = "object:", kMaterialPrefix = "material:", kFacePrefix = "face:";

std::optional<std::size_t> WholeNumber(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// Which patches a name belongs to; nothing if there is no such object, material or face.
using Named = std::optional<std::vector<bool>>;

template <class Holds>
std::vector<bool> PatchesWhere(const Scene& scene, const Holds& holds) {
  std::vector<bool> named(scene.patches.size());
  for (std::size_t p = 0; p < named.size(); ++p) named[p] = Emits(scene, p) && holds(scene.patches[p]);
  return named;
}

template <class Row, class Index>
Named OfRow(const Scene& scene, const std::vector<Row>& rows, std::string_view name, Index Patch::*index) {
  const auto is_named = [&](const Row& row) { return row.name == name; };
  if (std::none_of(rows.begin(), rows.end(), is_named)) return std::nullopt;
  return PatchesWhere(
      scene, [&](const Patch& patch) { return is_named(rows[static_cast<std::size_t>(patch.*index)]); });
}

Named OfFace(const Scene& scene, std::string_view text) {
  const std::optional<std::size_t> face = WholeNumber(text);
  if (!face || *face >= scene.faces.size()) return std::nullopt;
  return PatchesWhere(scene, [&](const Patch& patch) {
    return std::any_of(patch.faces.begin(), patch.faces.end(),
                       [&](std::int32_t f) { return static_cast<std::size_t>(f) == *face; });
  });
}

// The names that may be dimmed: of objects and materials that emit, without repetition.
std::vector<std::string> EmittingNames(const Scene& scene) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    if (Emits(scene, p) && static_cast<std::size_t>(scene.patches[p].object) < scene.objects.size())
      add(scene.objects[static_cast<std::size_t>(scene.patches[p].object)].name);
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    if (Emits(scene, p)) add(scene.MaterialOf(static_cast<PatchId>(p)).name);
  return names;
}

// "did you mean 'a', 'b' or 'c'?", of the names that are most like the given one.
std::string EmittersNear(const Scene& scene, std::string_view name) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> names = NearestFirst(name, EmittingNames(scene));
  if (names.empty()) return "nothing in it emits light";
  names.resize(std::min(names.size(), kMost));
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const char* between = i == 0 ? "" : i + 1 < names.size() ? ", " : " or ";
    list += between + ("'" + names[i] + "'");
  }
  return "did you mean " + list + "?";
}

struct NamedPatches {
  std::vector<bool> patches;
  bool by_face = false;  // the name is the number of a face
};

NamedPatches PatchesNamed(const Scene& scene, const std::string& full_name) {
  std::string_view name = full_name;
  const auto take = [&](std::string_view prefix) {
    if (!name.starts_with(prefix)) return false;
    name.remove_prefix(prefix.size());
    return true;
  };
  const auto object = [&] { return OfRow(scene, scene.objects, name, &Patch::object); };
  const auto material = [&] { return OfRow(scene, scene.materials, name, &Patch::material); };
  Named named;
  bool by_face = false;
  // A name that begins like a prefix may still be that of an object.
  if (Named whole = object()) {
    named = std::move(whole);
    const Named other = material();
    if (other && *other != *named)
      throw InputError("'" + full_name +
                       "' is an object and a material, of different emitters; write object:" + full_name +
                       " or material:" + full_name);
  } else if (whole = material(); whole) {
    named = std::move(whole);
  } else if (take(kObjectPrefix)) {
    named = object();
  } else if (take(kMaterialPrefix)) {
    named = material();
  } else {
    take(kFacePrefix);
    named = OfFace(scene, name);
    by_face = true;
  }
  if (!named)
    throw InputError("the scene has no object, material or face '" + full_name + "'; " +
                     EmittersNear(scene, name));
  if (std::find(named->begin(), named->end(), true) == named->end())
    throw InputError("'" + full_name + "' emits nothing; " + EmittersNear(scene, name));
  return {std::move(*named), by_face};
}

}  // namespace

std::vector<std::vector<PatchId>> EmittersOf(const Scene& scene, EmitterUnit unit) {
  const std::size_t count = scene.patches.size();
  JoinedSets sets(count);
  std::map<std::int32_t, std::size_t> first;  // patch of each face, object or material
  for (std::size_t p = 0; p < count; ++p) {
    if (!Emits(scene, p)) continue;
    const Patch& patch = scene.patches[p];
    const std::vector<std::int32_t> keys = unit == EmitterUnit::kFace     ? patch.faces
                                           : unit == EmitterUnit::kObject ? std::vector{patch.object}
                                                                          : std::vector{patch.material};
    for (const std::int32_t key : keys) sets.Join(first.try_emplace(key, p).first->second, p);
  }
  std::map<std::size_t, std::vector<PatchId>> by_first;
  for (std::size_t p = 0; p < count; ++p)
    if (Emits(scene, p)) by_first[sets.Find(p)].push_back(static_cast<PatchId>(p));
  std::vector<std::vector<PatchId>> emitters;
  for (auto& [lowest, patches] : by_first) emitters.push_back(std::move(patches));
  return emitters;
}

std::vector<Rgb> DimmingFactors(const Scene& scene, std::span<const Dimming> dimmings) {
  std::vector<Rgb> factors(scene.patches.size(), Rgb::Ones());
  std::vector<const Dimming*> by_face(scene.patches.size(), nullptr);
  for (const Dimming& dimming : dimmings) {
    const NamedPatches named = PatchesNamed(scene, dimming.name);
    for (std::size_t p = 0; p < factors.size(); ++p) {
      if (!named.patches[p]) continue;
      factors[p] *= dimming.factor;
      if (!named.by_face) continue;
      if (by_face[p])
        throw InputError("'" + by_face[p]->name + "' and '" + dimming.name +
                         "' are one emitter: their faces form one rectangle; name one of them");
      by_face[p] = &dimming;
    }
  }
  return factors;
}

void ScaleEmittance(Scene& scene, std::span<const Rgb> factor_of_patch) {
  PENUMBRA_CHECK(factor_of_patch.size() == scene.patches.size());
  // For each material, the factors of its patches, and the material with each factor. The material keeps its
  // place for the factor of its first patch.
  std::map<std::int32_t, std::vector<std::pair<Rgb, std::int32_t>>> made;
  const std::vector<Material> given = scene.materials;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    Patch& patch = scene.patches[p];
    const std::int32_t was = patch.material;
    const Material& material = given[static_cast<std::size_t>(was)];
    if ((material.emittance <= 0).all()) continue;
    const Rgb& factor = factor_of_patch[p];
    std::vector<std::pair<Rgb, std::int32_t>>& of_material = made[was];
    auto same = std::find_if(of_material.begin(), of_material.end(),
                             [&](const auto& other) { return (other.first == factor).all(); });
    if (same == of_material.end()) {
      Material scaled = material;
      scaled.emittance *= factor;
      if (scaled.emittance.maxCoeff() > kLargestEmittance)
        throw InputError("the emittance of '" + material.name + "' would exceed 1e100 W/m^2; give less");
      const bool is_first = of_material.empty();
      if (!is_first) scaled.name += "_dimmed_" + std::to_string(of_material.size());
      const std::int32_t at = is_first ? was : static_cast<std::int32_t>(scene.materials.size());
      if (is_first)
        scene.materials[static_cast<std::size_t>(was)] = std::move(scaled);
      else
        scene.materials.push_back(std::move(scaled));
      of_material.emplace_back(factor, at);
      same = of_material.end() - 1;
    }
    patch.material = same->second;
    for (const std::int32_t face : patch.faces)  // scenes made by programs may have patches alone
      if (static_cast<std::size_t>(face) < scene.faces.size())
        scene.faces[static_cast<std::size_t>(face)].material = patch.material;
  }
}

Scene LitOnlyBy(const Scene& scene, std::span<const PatchId> patches) {
  std::vector<Rgb> factors(scene.patches.size(), Rgb::Zero());
  for (const PatchId patch : patches) factors[static_cast<std::size_t>(patch)] = Rgb::Ones();
  Scene lit = scene;
  ScaleEmittance(lit, factors);
  return lit;
}

}  // namespace penumbra
