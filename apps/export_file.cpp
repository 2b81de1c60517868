#include "apps/export_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/option_values.h"
#include "apps/output.h"
#include "display/atlas/atlas_files.h"
#include "display/mesh_writers.h"
#include "solver/base/file_endings.h"
#include "solver/base/whole_file.h"
#include "solver/scene/scene_writers.h"

namespace penumbra {
namespace {

// Null if the ending names no such format.
std::unique_ptr<const MeshWriter> MeshWriterFor(const std::string& path) {
  const MeshWriterRegistry::Method* format = FindByEnding(MeshWriters(), path);
  return format ? format->make() : nullptr;
}

std::unique_ptr<const SceneWriter> SceneWriterFor(const std::string& path) {
  const SceneWriterRegistry::Method* format = FindByEnding(SceneWriters(), path);
  return format ? format->make() : nullptr;
}

// The endings of the writers that have what is asked for.
std::vector<std::string> EndingsWith(const auto& writers, const auto& has) {
  std::vector<std::string> endings;
  for (const auto& format : writers.methods())
    if (has(*format.make())) endings.push_back(format.name);
  return Dotted(endings);
}

// A line for each format of a kind.
std::string Formats(const auto& writers) {
  constexpr int kColumn = 6;
  std::string lines;
  for (const auto& format : writers.methods())
    lines += fmt::format("\n  {:<{}} {}", fmt::format(".{}", format.name), kColumn, format.help);
  return lines;
}

}  // namespace

std::optional<std::string> ExportFormatError(const std::string& path) {
  if (MeshWriterFor(path) || SceneWriterFor(path) || ExportsMap(path)) return std::nullopt;
  std::vector<std::string> endings = MeshWriters().Names();
  for (const std::string& ending : SceneWriters().Names()) endings.push_back(ending);
  return EndingError(path, endings);
}

bool ExportsMap(const std::string& path) {
  const std::vector<std::string> endings = AtlasEndings();
  return std::find(endings.begin(), endings.end(), EndingOf(path)) != endings.end();
}

bool IsMapOnly(const std::string& path) {
  return ExportsMap(path) && !MeshWriterFor(path) && !SceneWriterFor(path);
}

std::string EndingsOfMaps() { return NameList(Dotted(AtlasEndings())); }

std::vector<std::string> FilesBeside(const std::string& path) {
  const std::unique_ptr<const SceneWriter> writer = SceneWriterFor(path);
  return writer ? writer->FilesBeside(path) : std::vector<std::string>();
}

bool ExportsMesh(const std::string& path) { return MeshWriterFor(path) != nullptr; }

bool ExportsColours(const std::string& path) {
  const std::unique_ptr<const MeshWriter> writer = MeshWriterFor(path);
  return writer && writer->HasColours();
}

bool ExportsCamera(const std::string& path) {
  const std::unique_ptr<const SceneWriter> of_scene = SceneWriterFor(path);
  const std::unique_ptr<const MeshWriter> of_mesh = MeshWriterFor(path);
  return (of_scene && of_scene->HasCamera()) || (of_mesh && of_mesh->HasCamera());
}

std::string EndingsWithColours() {
  return NameList(EndingsWith(MeshWriters(), [](const MeshWriter& writer) { return writer.HasColours(); }));
}

std::string EndingsWithCamera() {
  const auto has_camera = [](const auto& writer) { return writer.HasCamera(); };
  std::vector<std::string> endings = EndingsWith(MeshWriters(), has_camera);
  for (const std::string& ending : EndingsWith(SceneWriters(), has_camera)) endings.push_back(ending);
  return NameList(endings);
}

std::string ExportFormats() {
  return "With the light, which is solved for first:" + Formats(MeshWriters()) +
         "\nIrradiance maps, with --atlas:"
         "\n  .exr   linear irradiance [W/m^2]"
         "\n  .png   exposure * irradiance, as a screen shows it"
         "\n  .glb   glTF 2.0: the patches, unlit, with their radiosity as a texture"
         "\nThe scene alone, nothing is solved:" +
         Formats(SceneWriters());
}

void ExportMesh(const std::string& path, const MeshExport& from) {
  const std::unique_ptr<const MeshWriter> writer = MeshWriterFor(path);
  PENUMBRA_CHECK(writer != nullptr);
  WriteResult(path, writer->Bytes(from));
}

void ExportMap(const std::string& path, const MeshExport& from, int size, AtlasPlaces places) {
  WriteResult(path, AtlasBytes(EndingOf(path), from, size, places));
}

void ExportScene(const std::string& path, const Scene& scene, const Camera& camera) {
  const std::unique_ptr<const SceneWriter> writer = SceneWriterFor(path);
  PENUMBRA_CHECK(writer != nullptr);
  std::vector<std::string> paths = writer->FilesBeside(path);
  paths.push_back(path);
  const std::vector<std::string> texts = writer->Texts(scene, camera, path);
  PENUMBRA_CHECK(texts.size() == paths.size());
  std::vector<FileToWrite> files;
  for (std::size_t i = 0; i < paths.size(); ++i) files.push_back({paths[i], texts[i]});
  WriteWholeFiles(files);
}

}  // namespace penumbra
