#include "solver/scene/assimp_reader.h"

#include <fmt/format.h>
#include <algorithm>

#include <filesystem>
#include <limits>
#include <utility>

#include "solver/base/child_process.h"
#include "solver/base/file_endings.h"
#include "solver/base/read_file.h"
#include "solver/base/size.h"
#include "solver/scene/assimp_import.h"
#include "solver/scene/file_format.h"
#include "solver/scene/foreign_formats.h"
#include "solver/scene/foreign_scene.h"
#include "solver/scene/gltf_details.h"
#include "solver/scene/material_check.h"
#include "solver/scene/scene_assembler.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// Assimp reads some ten megabytes a second, and never ends on some damaged files [s; s per byte].
constexpr double kLongestImport = 10, kLongestPerByte = 2e-6;

// Throws InputError if the file has what would change the light and cannot be read.
void RefuseWhatIsNotRead(const std::string& path, const ForeignScene& read, const GltfDetails& details) {
  if (!details.required.empty())
    throw ErrorAt(path, 0,
                  "it cannot be read without the extension " + QuotedList(details.required) +
                      ", which is not known here; export it without compression");
  if (read.lights.empty()) return;
  throw ErrorAt(path, 0,
                Plural(Size(read.lights), "light") + " without an area: " + QuotedList(read.lights) +
                    "; a radiosity scene is lit by faces: give the lamps faces that emit, and export without "
                    "lights");
}

// "textures of 2 materials: 'a', 'b'"; nothing for no materials.
void AddMaterials(const char* what, const std::vector<std::string>& names, std::vector<std::string>& list) {
  if (!names.empty())
    list.push_back(fmt::format("{} {}: {}", what, Plural(Size(names), "material"), QuotedList(names)));
}

std::vector<std::string> WhatIsLeftOut(const ForeignScene& read, const GltfDetails& details,
                                       const SceneOptions& options) {
  std::vector<std::string> textured, transparent, two_sided, metallic, list;
  for (const ForeignMaterial& material : read.materials) {
    if (material.textured) textured.push_back(material.name);
    if (material.transparent) transparent.push_back(material.name);
    if (material.two_sided && !options.two_sided) two_sided.push_back(material.name);
  }
  for (const int material : details.metallic)
    if (material < Size(read.materials))
      metallic.push_back(read.materials[static_cast<std::size_t>(material)].name);
  const auto add = [&](int count, const char* noun, const char* many) {
    if (count > 0) list.push_back(Plural(count, noun, "", many));
  };
  add(read.lines_and_points, "line or point", "s");
  add(read.cameras, "camera", "s");
  add(read.animations, "animation", "s");
  if (read.coloured_meshes > 0)
    list.push_back("the colours of vertices in " + Plural(read.coloured_meshes, "mesh", "", "es"));
  AddMaterials("the textures of", textured, list);
  AddMaterials("the transparency of", transparent, list);
  AddMaterials("the gloss of metal (its colour is taken as diffuse reflectance) of", metallic, list);
  AddMaterials("the second side (--two-sided gives every face a back) of", two_sided, list);
  return list;
}

class ForeignSceneBuilder {
 public:
  ForeignSceneBuilder(const std::string& path, const SceneOptions& options, const SceneFrame& frame)
      : path_(path), options_(options), frame_(frame), assembler_(path, options, scene_) {}

  Scene& scene() { return scene_; }

  Scene Build(const ForeignScene& read, const GltfDetails& details) {
    scene_.name = std::filesystem::path(path_).stem().string();
    for (const std::string& name : read.objects) scene_.objects.push_back({name, {}});
    AddMaterials(read, details);
    const std::vector<Vec3> corners = Corners(read);
    for (const ForeignFace& from : read.faces) {
      Face face;
      const auto first = corners.begin() + from.first;
      face.vertices.assign(first, first + from.size);
      const auto place = read.places.begin() + from.first;
      if (std::all_of(place, place + from.size, [](const Vec2& at) { return at.allFinite(); }))
        face.uv.assign(place, place + from.size);
      face.material = from.material < 0 ? DefaultMaterial() : from.material;
      face.object = from.object;
      scene_.objects[static_cast<std::size_t>(from.object)].faces.push_back(Size(scene_.faces));
      assembler_.Add(std::move(face), 0);
    }
    assembler_.Finish(frame_.Step(read.rounding));
    return std::move(scene_);
  }

 private:
  void AddMaterials(const ForeignScene& read, const GltfDetails& details) {
    // Files bring materials that no face uses. They are not checked.
    std::vector<bool> used(read.materials.size(), false);
    for (const ForeignFace& face : read.faces)
      if (face.material >= 0) used[static_cast<std::size_t>(face.material)] = true;
    for (std::size_t i = 0; i < read.materials.size(); ++i) {
      const ForeignMaterial& from = read.materials[i];
      Material material;
      material.name = from.name.empty() ? fmt::format("material {}", i) : from.name;
      if (used[i]) {
        const auto strength = details.emissive_strength.find(static_cast<int>(i));
        material.reflectance = from.diffuse;
        material.emittance =
            from.emission * (strength == details.emissive_strength.end() ? 1.0 : strength->second);
      }
      scene_.materials.push_back(std::move(material));
    }
    CheckMaterials(path_, options_, scene_.materials, scene_.warnings);
  }

  std::int32_t DefaultMaterial() {
    if (default_ < 0) {
      default_ = Size(scene_.materials);
      scene_.materials.emplace_back().name = "default";
    }
    return default_;
  }

  // In the frame of the scene, checked.
  std::vector<Vec3> Corners(const ForeignScene& read) const {
    std::vector<Vec3> corners;
    corners.reserve(read.corners.size());
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3& from : read.corners) {
      const Vec3 corner = frame_.Position(from);
      if (!(MaxAbs(corner) <= kLargestCoordinate))
        throw ErrorAt(
            path_, 0,
            "a coordinate is not a number, or beyond 1e36 m; the file is damaged, or its unit is not " +
                frame_.unit.name);
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
      corners.push_back(corner);
    }
    if (!corners.empty()) assembler_.CheckSize(low, high);
    return corners;
  }

  const std::string& path_;
  const SceneOptions& options_;
  SceneFrame frame_;
  Scene scene_;
  SceneAssembler assembler_;
  std::int32_t default_ = -1;
};

ForeignScene ImportInChild(const std::string& path, const std::string& bytes, const AssimpImport& how,
                           const std::string& format) {
  const double most = kLongestImport + kLongestPerByte * static_cast<double>(bytes.size());
  const ChildResult result =
      RunInChild([&] { return EncodeForeignScene(ImportByAssimp(bytes, path, how)); }, most);
  const std::string what = "it cannot be read as " + format + ": ";
  constexpr const char* kMend =
      "; the file is damaged or of an unusual kind; export it anew, or as GLB or OBJ";
  constexpr std::size_t kLongestReason = 200;  // [bytes]
  switch (result.end) {
    case ChildResult::End::kReturned:
      return DecodeForeignScene(result.bytes);
    case ChildResult::End::kThrew:
      throw ErrorAt(path, 0, what + Printable(result.bytes, kLongestReason) + kMend);
    case ChildResult::End::kTookTooLong:
      throw ErrorAt(path, 0, what + fmt::format("Assimp did not end within {:.0f} s", most) + kMend);
    default:
      throw ErrorAt(path, 0, what + "Assimp crashed" + kMend);
  }
}

SceneFrame UsedFrame(const ForeignFrame& said, const SceneOptions& options) {
  return {options.unit.value_or(said.frame.unit), options.up.value_or(said.frame.up)};
}

// What was read, and in which frame; and what was left out.
std::vector<std::string> Notes(const std::string& path, const ForeignFormatEntry& format,
                               const ForeignFrame& said, const SceneOptions& options,
                               const ForeignScene& read, const std::vector<std::string>& left_out) {
  const SceneFrame frame = UsedFrame(said, options);
  const auto source = [](bool given, bool by_file) {
    return given ? "as given" : by_file ? "as the file says" : "assumed";
  };
  std::vector<std::string> notes = {
      fmt::format("{}: note: read as {}: {}, {}, {}; one unit of length is {} ({}), {} is up ({})",
                  PlaceOf(path, 0), format.name, Plural(Size(read.faces), "face"),
                  Plural(Size(read.objects), "object"), Plural(Size(read.materials), "material"),
                  frame.unit.name, source(options.unit.has_value(), said.unit_said), NameOf(frame.up),
                  source(options.up.has_value(), said.up_said))};
  if (!left_out.empty())
    notes.push_back(WarningAt(path, 0, fmt::format("left out: {}", fmt::join(left_out, "; "))));
  return notes;
}

Scene ReadForeign(const std::string& path, const ForeignFormatEntry& format, const std::string& bytes,
                  const SceneOptions& options) {
  AssimpImport how = format.import;
  if (format.name == "COLLADA") how.applied_unit = ColladaFrame(bytes).frame.unit.Metres();
  const bool is_gltf = format.name == "glTF" || format.name == "GLB";
  const GltfDetails details = is_gltf ? FindGltfDetails(bytes) : GltfDetails();
  const ForeignScene read = ImportInChild(path, bytes, how, format.name);
  if (options.before_library)
    for (const std::string& file : read.files) options.before_library(file);
  RefuseWhatIsNotRead(path, read, details);
  const ForeignFrame said = FrameOf(format, bytes, read);
  ForeignSceneBuilder builder(path, options, UsedFrame(said, options));
  builder.scene().warnings = Notes(path, format, said, options, read, WhatIsLeftOut(read, details, options));
  return builder.Build(read, details);
}

class AssimpReader final : public SceneReader {
 public:
  std::vector<std::string> Endings() const override {
    std::vector<std::string> endings;
    for (const ForeignFormatEntry& format : ForeignFormats())
      endings.insert(endings.end(), format.endings.begin(), format.endings.end());
    return endings;
  }
  bool RecognisesContent(const SceneSource& source) const override {
    return FormatByContent(source.beginning) != nullptr;
  }
  bool Recognises(const SceneSource& source) const override {
    // What is known to be something else is none of these, whatever its name.
    const std::optional<ForeignFormat> other = FindForeignFormat(source.beginning);
    return source.is_file && FormatByEnding(EndingOf(source.name)) &&
           (!other || other->kind == FormatKind::kScene);
  }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    std::string bytes;
    try {
      bytes = ReadFileBytes(name);
    } catch (const ReadFailure& failure) {
      throw ErrorAt(name, 0, std::string(failure.what()) + "; give a scene file that can be read");
    }
    const ForeignFormatEntry* format = FormatByContent(std::string_view(bytes).substr(0, kFormatBytes));
    if (!format) format = FormatByEnding(EndingOf(name));
    PENUMBRA_CHECK(format != nullptr);
    return ReadForeign(name, *format, bytes, options);
  }
};

}  // namespace

SceneReaderRegistry::Method AssimpReaderMethod() {
  return {"assimp",
          "glTF, GLB, STL, COLLADA, 3DS, FBX, X3D, OFF, DXF, AC3D and LightWave, through Assimp",
          {},
          [] { return std::make_unique<const AssimpReader>(); }};
}

}  // namespace penumbra
