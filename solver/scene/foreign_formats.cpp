#include "solver/scene/foreign_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/scene/file_format.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

constexpr bool kNo = false, kYes = true;

// Files of formats without a say on axes stand on z, as OBJ files do here, except where the programs of the
// format have y up.
std::vector<ForeignFormatEntry> MakeFormats() {
  const AssimpImport bare = {"", kNo, kNo, kNo, 1}, turned = {"", kYes, kNo, kYes, 1},
                     bare_turned = {"", kNo, kNo, kYes, 1}, with_default = {"", kYes, kYes, kNo, 1};
  return {{"glTF", {"gltf"}, "a glTF file", with_default, UpAxis::kY},
          {"GLB", {"glb"}, "a glTF file (GLB)", with_default, UpAxis::kY},
          {"STL", {"stl"}, "an STL file", bare},
          {"COLLADA", {"dae"}, "a COLLADA file", {}, UpAxis::kY},
          {"3DS", {"3ds"}, "a 3D Studio file (3DS)", turned},
          {"FBX", {"fbx"}, "an FBX file", {}, UpAxis::kY},
          {"X3D", {"x3d"}, "an X3D file", {}, UpAxis::kY},
          {"OFF", {"off"}, "an OFF file", bare},
          {"DXF", {"dxf"}, "a DXF drawing", bare_turned},
          {"AC3D", {"ac", "ac3d"}, "an AC3D file", {}, UpAxis::kY},
          {"LightWave", {"lwo"}, "a LightWave file", {}, UpAxis::kY}};
}

// The text between `name="` and the next quotation mark in an element of XML.
std::string_view Attribute(std::string_view element, std::string_view name) {
  std::size_t at = 0;
  while ((at = element.find(name, at)) != element.npos) {
    const std::size_t before = at;
    at += name.size();
    const std::size_t equals = element.find_first_not_of(" \t\r\n", at);
    if (before == 0 || element.find_first_of(" \t\r\n", before - 1) != before - 1 || equals == element.npos ||
        element[equals] != '=')
      continue;
    const std::size_t quote = element.find_first_of("\"'", equals);
    if (quote == element.npos) return {};
    const std::size_t end = element.find(element[quote], quote + 1);
    return end == element.npos ? std::string_view() : element.substr(quote + 1, end - quote - 1);
  }
  return {};
}

}  // namespace

const std::vector<ForeignFormatEntry>& ForeignFormats() {
  static const std::vector<ForeignFormatEntry> formats = [] {
    std::vector<ForeignFormatEntry> made = MakeFormats();
    for (ForeignFormatEntry& format : made) format.import.ending = format.endings.front();
    return made;
  }();
  return formats;
}

const ForeignFormatEntry* FormatByContent(std::string_view beginning) {
  const std::optional<ForeignFormat> found = FindForeignFormat(beginning);
  if (!found) return nullptr;
  for (const ForeignFormatEntry& format : ForeignFormats())
    if (format.description == found->name) return &format;
  return nullptr;
}

const ForeignFormatEntry* FormatByEnding(std::string_view ending) {
  for (const ForeignFormatEntry& format : ForeignFormats())
    if (std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end())
      return &format;
  return nullptr;
}

ForeignFrame ColladaFrame(std::string_view bytes) {
  ForeignFrame result;
  result.frame.up = UpAxis::kY;
  const std::size_t unit = bytes.find("<unit");
  if (unit != bytes.npos) {
    const std::string_view element = bytes.substr(unit, bytes.find('>', unit) - unit);
    const std::optional<double> metres = ToNumber(Attribute(element, "meter"));
    if (metres && *metres > 0 && std::isfinite(*metres)) {
      result.frame.unit = {fmt::format("{} m", *metres), *metres, 1};
      if (*metres == 1) result.frame.unit = {"m"};
      result.unit_said = true;
    }
  }
  constexpr std::string_view kUp = "<up_axis>";
  const std::size_t up = bytes.find(kUp);
  if (up == bytes.npos) return result;
  std::string_view axis = bytes.substr(up + kUp.size());
  axis.remove_prefix(std::min(axis.find_first_not_of(" \t\r\n"), axis.size()));
  result.up_said = axis.starts_with("X_UP") || axis.starts_with("Y_UP") || axis.starts_with("Z_UP");
  if (axis.starts_with("X_UP")) result.frame.up = UpAxis::kX;
  if (axis.starts_with("Z_UP")) result.frame.up = UpAxis::kZ;
  return result;
}

ForeignFrame FrameOf(const ForeignFormatEntry& format, std::string_view bytes, const ForeignScene& read) {
  if (format.name == "COLLADA") return ColladaFrame(bytes);
  ForeignFrame result;
  result.frame.up = format.up;
  const bool is_gltf = format.name == "glTF" || format.name == "GLB";
  result.unit_said = result.up_said = is_gltf;  // by the standard
  if (read.centimetres > 0 && std::isfinite(read.centimetres)) {
    result.frame.unit = {fmt::format("{} cm", read.centimetres), read.centimetres, 100};
    if (read.centimetres == 1) result.frame.unit.name = "cm";
    if (read.centimetres == 100) result.frame.unit = {"m"};
    result.unit_said = true;
  }
  if (read.up >= 0 && read.up <= 2) {
    result.frame.up = read.up == 0 ? UpAxis::kX : read.up == 1 ? UpAxis::kY : UpAxis::kZ;
    result.up_said = true;
  }
  return result;
}

}  // namespace penumbra
