#include "solver/scene/named_scene.h"

#include <filesystem>
#include <memory>
#include <vector>

#include "solver/base/read_file.h"
#include "solver/base/similar_names.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/file_format.h"
#include "solver/scene/scene_readers.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// The names of the built-in scenes, those first that are most like the given one.
std::string NamesNear(const std::string& name) {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : BuiltinScenes()) names.push_back(scene.name);
  std::string list;
  for (const std::string& known : NearestFirst(name, names)) list += (list.empty() ? "" : ", ") + known;
  return list + DidYouMean(name, names);
}

// What shows a file's format; nothing of a file that cannot be read, as its reader will tell.
std::string BeginningOf(const std::string& path) {
  try {
    return ReadFileStart(path, kFormatBytes);
  } catch (const ReadFailure&) {
    return "";
  }
}

// Throws InputError if a file that no reader recognises is known to be no text of an OBJ file.
void RefuseOtherFormats(const std::string& name, std::string_view beginning) {
  const std::optional<ForeignFormat> format = FindForeignFormat(beginning);
  if (!format) return;
  std::string endings;
  for (const SceneReaderRegistry::Method& method : SceneReaders().methods())
    for (const std::string& ending : method.make()->Endings())
      endings += (endings.empty() ? "." : ", .") + ending;
  throw ErrorAt(name, 0, ForeignFormatMessage(*format, "a scene file (" + endings + ")"));
}

}  // namespace

Scene ReadNamedScene(const std::string& name, const SceneOptions& options) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(name, error);
  const bool is_directory = std::filesystem::is_directory(status);
  const bool is_file = std::filesystem::exists(status) && !is_directory;
  const std::string beginning = std::filesystem::is_regular_file(status) ? BeginningOf(name) : "";
  for (const SceneReaderRegistry::Method& method : SceneReaders().methods()) {
    const std::unique_ptr<const SceneReader> reader = method.make();
    if (is_file && reader->RecognisesContent({name, is_file, beginning})) return reader->Read(name, options);
  }
  for (const SceneReaderRegistry::Method& method : SceneReaders().methods()) {
    const std::unique_ptr<const SceneReader> reader = method.make();
    if (reader->Recognises({name, is_file, beginning})) return reader->Read(name, options);
  }
  if (is_file) RefuseOtherFormats(name, beginning);
  if (is_file) return SceneReaders().methods().front().make()->Read(name, options);
  if (is_directory) throw ErrorAt(name, 0, "it is a directory; name an OBJ file in it");
  if (error && error != std::errc::no_such_file_or_directory)
    throw ErrorAt(name, 0, "it cannot be read: " + error.message() + "; give an OBJ file that can be read");
  throw ErrorAt(name, 0, "there is no such file, and no built-in scene of that name: " + NamesNear(name));
}

}  // namespace penumbra
