#include "apps/export_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/option_values.h"
#include "apps/output.h"
#include "display/mesh_nodes.h"
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
template <class Writers>
std::string EndingsWith(const Writers& writers, const auto& has) {
  std::vector<std::string> endings;
  for (const auto& format : writers.methods())
    if (has(*format.make())) endings.push_back(format.name);
  return NameList(Dotted(endings));
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
  if (MeshWriterFor(path) || SceneWriterFor(path)) return std::nullopt;
  std::vector<std::string> endings = MeshWriters().Names();
  for (const std::string& ending : SceneWriters().Names()) endings.push_back(ending);
  return EndingError(path, endings);
}

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
  const std::unique_ptr<const SceneWriter> writer = SceneWriterFor(path);
  return writer && writer->HasCamera();
}

std::string EndingsWithColours() {
  return EndingsWith(MeshWriters(), [](const MeshWriter& writer) { return writer.HasColours(); });
}

std::string EndingsWithCamera() {
  return EndingsWith(SceneWriters(), [](const SceneWriter& writer) { return writer.HasCamera(); });
}

std::string ExportFormats() {
  return "With the light, which is solved for first:" + Formats(MeshWriters()) +
         "\nThe scene alone, nothing is solved:" + Formats(SceneWriters());
}

void ExportMesh(const std::string& path, const Scene& scene, const IrradianceMesh& mesh,
                std::optional<double> exposure) {
  const std::unique_ptr<const MeshWriter> writer = MeshWriterFor(path);
  PENUMBRA_CHECK(writer != nullptr);
  if (!exposure && writer->HasColours()) exposure = MeterMesh(scene, mesh);
  WriteResult(path, writer->Bytes(scene, mesh, exposure.value_or(1)));
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
