#include "apps/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/option_values.h"
#include "display/camera.h"
#include "solver/base/read_file.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

constexpr std::string_view kLineForm = "EYE LOOK-AT [UP [FOV]], with points as x,y,z";
constexpr int kFewestDigits = 4;

std::vector<std::string_view> WordsOf(std::string_view line) {
  constexpr std::string_view kBlanks = " \t";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != line.npos;
       at = line.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

Camera CameraFrom(const std::vector<std::string_view>& words, const Camera& otherwise) {
  if (words.size() < 2 || words.size() > 4)
    throw InputError(fmt::format("a line is {}; this one has {} words", kLineForm, words.size()));
  const auto vector = [&](std::string_view word, const VectorRule& rule) {
    const std::optional<Vec3> value = ParseVector(word);
    if (!value || !rule.holds(*value))
      throw InputError(fmt::format("{} is not {}; a line is {}", Quoted(word), rule.words, kLineForm));
    return *value;
  };
  Camera camera = otherwise;
  camera.name.clear();
  camera.eye = vector(words[0], kPoint);
  camera.look_at = vector(words[1], kPoint);
  if (words.size() > 2) {
    camera.up = vector(words[2], kDirection);
    if (!CanBeUp(camera.up, camera))
      throw InputError("the up direction is parallel to the view; give another direction");
  }
  if (words.size() > 3) {
    const std::optional<double> fov = ParseNumber(words[3]);
    if (!fov) throw InputError(fmt::format("{} is no field of view in degrees", Quoted(words[3])));
    camera.vertical_fov = *fov;
  }
  ValidateCamera(camera);
  return camera;
}

}  // namespace

std::vector<Camera> ReadCameraText(std::string_view text, const std::string& path, const Camera& otherwise) {
  std::vector<Camera> cameras;
  LineReader lines(text);
  while (!lines.AtEnd()) {
    const int line = lines.NextLine();
    const std::vector<std::string_view> words = WordsOf(lines.Take());
    if (words.empty() || words.front().starts_with('#')) continue;
    try {
      cameras.push_back(CameraFrom(words, otherwise));
    } catch (const InputError& error) {
      throw ErrorAt(path, line, error.what());
    }
  }
  if (cameras.empty()) throw ErrorAt(path, 0, fmt::format("it has no camera; a line is {}", kLineForm));
  return cameras;
}

std::vector<Camera> ReadCameraPath(const std::string& path, const Camera& otherwise) {
  try {
    return ReadCameraText(ReadFileBytes(path), path, otherwise);
  } catch (const ReadFailure& failure) {
    throw ErrorAt(path, 0, std::string(failure.what()) + "; give a file of cameras that can be read");
  }
}

std::string FramePath(const std::string& output, std::size_t index, std::size_t count) {
  const std::filesystem::path path(output);
  const int digits =
      std::max(kFewestDigits, static_cast<int>(std::to_string(std::max<std::size_t>(count, 1) - 1).size()));
  const std::string name =
      fmt::format("{}-{:0{}}{}", path.stem().string(), index, digits, path.extension().string());
  return (path.parent_path() / name).string();
}

}  // namespace penumbra
