#include "solver/scene/gltf_details.h"

#include <cstdint>
#include <nlohmann/json.hpp>

namespace penumbra {
namespace {

using nlohmann::json;

std::uint32_t LittleEndian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// GLB: "glTF", the version and the length of the file; then the first chunk's length, its type and its
// content.
std::string_view JsonPart(std::string_view bytes) {
  constexpr std::size_t kHeader = 20;
  if (!bytes.starts_with("glTF")) return bytes;
  if (bytes.size() < kHeader || LittleEndian(bytes, 4) != 2) return {};
  return bytes.substr(kHeader, LittleEndian(bytes, 12));
}

// A member of an object; null if there is none.
const json& Member(const json& object, const char* name) {
  static const json null;
  if (!object.is_object()) return null;
  const auto found = object.find(name);
  return found == object.end() ? null : *found;
}

bool ConcernsLookOnly(const std::string& extension) {
  for (const char* beginning : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"})
    if (extension.starts_with(beginning)) return true;
  return false;
}

}  // namespace

GltfDetails FindGltfDetails(std::string_view bytes) {
  GltfDetails details;
  const json file = json::parse(JsonPart(bytes), nullptr, false);
  if (file.is_discarded()) return details;
  int number = 0;
  for (const json& material : Member(file, "materials")) {
    const json& strength =
        Member(Member(Member(material, "extensions"), "KHR_materials_emissive_strength"), "emissiveStrength");
    if (strength.is_number()) details.emissive_strength[number] = strength.get<double>();
    const json& metallic = Member(Member(material, "pbrMetallicRoughness"), "metallicFactor");
    if (metallic.is_number() && metallic.get<double>() > 0) details.metallic.push_back(number);
    ++number;
  }
  for (const json& extension : Member(file, "extensionsRequired"))
    if (extension.is_string() && !ConcernsLookOnly(extension.get<std::string>()))
      details.required.push_back(extension.get<std::string>());
  return details;
}

}  // namespace penumbra
