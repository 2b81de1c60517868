#include "apps/named_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "apps/option_values.h"
#include "solver/base/check.h"
#include "solver/base/similar_names.h"

namespace penumbra {
namespace {

std::vector<std::string> ObjectNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const Object& object : scene.objects) names.push_back(object.name);
  return names;
}

// The face with the number that `name` is.
std::int32_t FaceNumbered(const Scene& scene, const std::string& scene_name, const std::string& name) {
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: error: {}", scene_name, what));
  };
  std::size_t index = 0;
  const char *begin = name.data(), *end = begin + name.size();
  const auto [stop, error] = std::from_chars(begin, end, index);
  if (stop != end || name.empty() || error == std::errc::invalid_argument)
    fail(
        fmt::format("there is no object or group `{}`; there are {}, and faces by the number of their f "
                    "line, from 0{}",
                    name, scene.objects.empty() ? "none" : NameList(ObjectNames(scene)),
                    DidYouMean(name, ObjectNames(scene))));
  if (error != std::errc() || index >= scene.faces.size())
    fail(scene.faces.empty() ? fmt::format("there is no face {}; the scene has none", name)
                             : fmt::format("there is no face {}; faces have the numbers 0 to {}", name,
                                           scene.faces.size() - 1));
  return static_cast<std::int32_t>(index);
}

}  // namespace

std::vector<std::int32_t> FacesNamed(const Scene& scene, const std::string& scene_name,
                                     const std::string& name) {
  std::vector<std::int32_t> faces;
  bool is_named = false;
  for (const Object& object : scene.objects) {
    if (object.name != name) continue;
    is_named = true;
    faces.insert(faces.end(), object.faces.begin(), object.faces.end());
  }
  if (!is_named) faces.push_back(FaceNumbered(scene, scene_name, name));
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}  // namespace penumbra
