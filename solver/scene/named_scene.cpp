#include "solver/scene/named_scene.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/base/read_file.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/file_format.h"
#include "solver/scene/scene_readers.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// How many letters have to be inserted, removed or replaced to make one word of the other.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

// The names of the built-in scenes, those first that are most like the given one.
std::string NamesNear(std::string_view name) {
  constexpr std::size_t kLongestName = 100;  // longer ones are like none
  name = name.substr(0, kLongestName);
  std::vector<std::pair<std::size_t, std::string>> names;
  for (const BuiltinScene& scene : BuiltinScenes())
    names.emplace_back(EditDistance(name, scene.name), scene.name);
  std::stable_sort(names.begin(), names.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string list;
  for (const auto& [distance, known] : names) list += (list.empty() ? "" : ", ") + known;
  return list;
}

// What shows a file's format; nothing of a file that cannot be read, as its reader will tell.
std::string BeginningOf(const std::string& path) {
  try {
    return ReadFileStart(path, kFormatBytes);
  } catch (const ReadFailure&) {
    return "";
  }
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
    if (reader->Recognises({name, is_file, beginning})) return reader->Read(name, options);
  }
  if (is_file) return SceneReaders().methods().front().make()->Read(name, options);
  if (is_directory) throw ErrorAt(name, 0, "it is a directory; name an OBJ file in it");
  if (error && error != std::errc::no_such_file_or_directory)
    throw ErrorAt(name, 0, "it cannot be read: " + error.message() + "; give an OBJ file that can be read");
  throw ErrorAt(name, 0, "there is no such file, and no built-in scene of that name: " + NamesNear(name));
}

}  // namespace penumbra
