#include "apps/export_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "apps/output.h"
#include "display/mesh_export.h"
#include "solver/base/whole_file.h"
#include "solver/scene/mgf_writer.h"
#include "solver/scene/obj_writer.h"
#include "solver/scene/pbrt_writer.h"

namespace penumbra {
namespace {

constexpr std::array<const char*, 3> kMeshFormats = {".vtu", ".ply", ".glb"},
                                     kSceneFormats = {".obj", ".pbrt", ".mgf"};
constexpr int kFilmWidth = 1280, kFilmHeight = 960;  // what pbrt draws [pixels]

std::string FormatOf(const std::string& path) { return std::filesystem::path(path).extension().string(); }

bool Contains(const std::array<const char*, 3>& formats, const std::string& format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

}  // namespace

std::optional<std::string> ExportFormatError(const std::string& path) {
  if (Contains(kMeshFormats, FormatOf(path)) || Contains(kSceneFormats, FormatOf(path))) return std::nullopt;
  return fmt::format("'{}' ends in none of .vtu, .ply, .glb, .obj, .pbrt, .mgf", path);
}

std::optional<std::string> LibraryBeside(const std::string& path) {
  if (FormatOf(path) != ".obj") return std::nullopt;
  return std::filesystem::path(path).replace_extension(".mtl").string();
}

bool ExportsMesh(const std::string& path) { return Contains(kMeshFormats, FormatOf(path)); }

void ExportMesh(const std::string& path, const Scene& scene, const IrradianceMesh& mesh,
                std::optional<double> exposure) {
  const std::string format = FormatOf(path);
  if (format == ".vtu") {
    WriteResult(path, VtuBytes(scene, mesh));
  } else {
    const double chosen = exposure.value_or(MeterMesh(scene, mesh));
    WriteResult(path, format == ".ply" ? PlyBytes(scene, mesh, chosen) : GlbBytes(scene, mesh, chosen));
  }
}

void ExportScene(const std::string& path, const Scene& scene, const Camera& camera) {
  const std::string format = FormatOf(path);
  if (format == ".pbrt") {
    WriteResult(path, PbrtText(scene, camera, kFilmWidth, kFilmHeight));
  } else if (format == ".mgf") {
    WriteResult(path, MgfText(scene));
  } else {
    const std::string library = *LibraryBeside(path), materials = MtlText(scene);
    const std::string text = ObjText(scene, std::filesystem::path(library).filename().string());
    WriteWholeFiles(std::array<FileToWrite, 2>{{{library, materials}, {path, text}}});
  }
}

}  // namespace penumbra
