#include "solver/scene/polygon_soup.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <utility>

#include "solver/base/size.h"
#include "solver/scene/material_check.h"
#include "solver/scene/text_reader.h"

namespace penumbra {

PolygonSoup::PolygonSoup(const std::string& path, const SceneOptions& options)
    : path_(path),
      options_(options),
      frame_{options.unit.value_or(LengthUnit{"m"}), options.up.value_or(UpAxis::kZ)} {
  scene_.name = std::filesystem::path(path).stem().string();
}

std::int32_t PolygonSoup::ObjectNamed(const std::string& name) {
  const auto [at, is_new] = object_index_.try_emplace(name, Size(scene_.objects));
  if (is_new) scene_.objects.push_back({name, {}});
  return at->second;
}

std::int32_t PolygonSoup::MaterialLike(const Material& material) {
  std::vector<std::int32_t>& same_name = material_index_[material.name];
  for (const std::int32_t index : same_name) {
    const Material& other = scene_.materials[static_cast<std::size_t>(index)];
    if ((other.reflectance == material.reflectance).all() && (other.emittance == material.emittance).all())
      return index;
  }
  same_name.push_back(Size(scene_.materials));
  scene_.materials.push_back(material);
  if (same_name.size() > 1) scene_.materials.back().name += fmt::format("_{}", same_name.size());
  return same_name.back();
}

void PolygonSoup::Add(Polygon3 polygon, std::int32_t material, std::int32_t object, int line) {
  for (Vec3& corner : polygon) {
    corner = frame_.Position(corner);
    if (!(MaxAbs(corner) <= kLargestCoordinate))
      throw ErrorAt(path_, line,
                    "a coordinate is not a number, or beyond 1e36 m; lengths are in " + frame_.unit.name);
  }
  pieces_.push_back({{std::move(polygon), material, object}, line});
}

Scene PolygonSoup::Finish(std::string_view format) {
  scene_.warnings.insert(
      scene_.warnings.begin(),
      fmt::format("{}: note: read as {}: {}, {}, {}; one unit of length is {} ({}), {} is up ({})",
                  PlaceOf(path_, 0), format, Plural(Size(pieces_), "face"),
                  Plural(Size(scene_.objects), "object"), Plural(Size(scene_.materials), "material"),
                  frame_.unit.name, options_.unit ? "as given" : "assumed", NameOf(frame_.up),
                  options_.up ? "as given" : "assumed"));
  CheckMaterials(path_, options_, scene_.materials, scene_.warnings);
  SceneAssembler assembler(path_, options_, scene_);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Piece& piece : pieces_)
    for (const Vec3& corner : piece.face.vertices) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  if (!pieces_.empty()) assembler.CheckSize(low, high);
  for (Piece& piece : pieces_) {
    scene_.objects[static_cast<std::size_t>(piece.face.object)].faces.push_back(Size(scene_.faces));
    assembler.Add(std::move(piece.face), piece.line);
  }
  pieces_.clear();
  assembler.Finish(frame_.Step(step_));
  return std::move(scene_);
}

}  // namespace penumbra
