#include "python/array_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <string_view>
#include <utility>

#include "solver/base/check.h"
#include "solver/scene/obj_reader.h"

namespace penumbra {
namespace {

constexpr const char* kObjName = "arrays.obj";
constexpr const char* kMtlName = "arrays.mtl";

// What the lines of the text hold, to say it in messages.
struct ArrayText {
  std::string obj, mtl;
  std::vector<std::int64_t> face_at;  // the face in each line, -1 for none
  std::size_t vertices = 0, vertices_from = 0;
};

void AddLine(ArrayText* text, std::string_view line, std::int64_t face = -1) {
  text->obj += line;
  text->obj += '\n';
  text->face_at.push_back(face);
}

// The number of the material of each face; equal faces share one. Writes them as a library.
std::vector<std::size_t> AddMaterials(const SceneArrays& arrays, ArrayText* text) {
  std::map<std::array<double, 6>, std::size_t> numbers;
  std::vector<std::size_t> of_face;
  for (std::size_t i = 0; i < arrays.faces.size(); ++i) {
    const Rgb &kd = arrays.reflectance[i], &ke = arrays.emittance[i];
    const auto [at, is_new] = numbers.try_emplace({kd[0], kd[1], kd[2], ke[0], ke[1], ke[2]}, numbers.size());
    of_face.push_back(at->second);
    if (is_new)
      text->mtl += fmt::format("newmtl material{}\nKd {} {} {}\nKe {} {} {}\n", at->second, kd[0], kd[1],
                               kd[2], ke[0], ke[1], ke[2]);
  }
  return of_face;
}

ArrayText TextOfArrays(const SceneArrays& arrays) {
  ArrayText text;
  const std::vector<std::size_t> materials = AddMaterials(arrays, &text);
  AddLine(&text, fmt::format("mtllib {}", kMtlName));
  text.vertices_from = text.face_at.size();
  text.vertices = arrays.vertices.size();
  for (const Vec3& v : arrays.vertices) AddLine(&text, fmt::format("v {} {} {}", v.x(), v.y(), v.z()));
  for (std::size_t i = 0; i < arrays.faces.size(); ++i) {
    const auto face = static_cast<std::int64_t>(i);
    if (!arrays.objects.empty() && (i == 0 || arrays.objects[i] != arrays.objects[i - 1]))
      AddLine(&text, fmt::format("o {}", arrays.objects[i]), face);
    if (i == 0 || materials[i] != materials[i - 1])
      AddLine(&text, fmt::format("usemtl material{}", materials[i]), face);
    std::string line = "f";
    for (const std::int64_t vertex : arrays.faces[i]) line += fmt::format(" {}", vertex + 1);
    AddLine(&text, line, face);
  }
  return text;
}

// The message with the name of the scene, and with the face or vertex instead of the line.
std::string WithoutLines(const std::string& message, const ArrayText& text, const std::string& name) {
  static const std::regex kPlace("^arrays\\.(obj|mtl)(:([0-9]+))?: ");
  std::smatch found;
  if (!std::regex_search(message, found, kPlace)) return message;
  std::string place;
  if (found[1] == "obj" && found[3].matched) {
    const std::size_t line = std::stoul(found[3]) - 1;
    const std::int64_t face = line < text.face_at.size() ? text.face_at[line] : -1;
    if (face >= 0)
      place = fmt::format("face {}: ", face);
    else if (line >= text.vertices_from && line < text.vertices_from + text.vertices)
      place = fmt::format("vertex {}: ", line - text.vertices_from);
  }
  return fmt::format("{}: {}{}", name, place, found.suffix().str());
}

[[noreturn]] void FailAtFace(const SceneArrays& arrays, std::size_t face, const std::string& what) {
  throw InputError(fmt::format("{}: face {}: error: {}", arrays.name, face, what));
}

// A name that a line of a file can hold.
bool IsPlainName(const std::string& name) {
  return !name.empty() && name.front() != ' ' && name.back() != ' ' && name.back() != '\\' &&
         std::all_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x20; });
}

// Checks what the text could not say, or would say in the words of files.
void CheckArrays(const SceneArrays& arrays, const SceneOptions& options) {
  const auto count = static_cast<std::int64_t>(arrays.vertices.size());
  for (std::size_t i = 0; i < arrays.faces.size(); ++i) {
    for (const std::int64_t vertex : arrays.faces[i])
      if (vertex < 0 || vertex >= count)
        FailAtFace(arrays, i,
                   count == 0 ? fmt::format("there is no vertex {}, nor any other", vertex)
                              : fmt::format("there is no vertex {}; vertices have the numbers 0 to {}",
                                            vertex, count - 1));
    const Rgb &rho = arrays.reflectance[i], &emittance = arrays.emittance[i];
    if (!(rho >= 0).all() || (!options.max_reflectance && !(rho < 1).all()))
      FailAtFace(arrays, i,
                 fmt::format("the reflectance is {}, {}, {}; give numbers in [0, 1), or max_reflectance",
                             rho[0], rho[1], rho[2]));
    if (!(emittance >= 0).all() || !(emittance <= kLargestEmittance).all())
      FailAtFace(arrays, i,
                 fmt::format("the emittance is {}, {}, {}; give numbers of 0 or more, up to 1e100 W/m^2",
                             emittance[0], emittance[1], emittance[2]));
    if (!arrays.objects.empty() && !IsPlainName(arrays.objects[i]))
      FailAtFace(arrays, i, "the name of its object is empty, or has blanks at an end or control characters");
  }
}

}  // namespace

Scene SceneFromArrays(const SceneArrays& arrays, const SceneOptions& options) {
  CheckArrays(arrays, options);
  const ArrayText text = TextOfArrays(arrays);
  const MtlSource library = [&](std::string_view) { return std::optional(text.mtl); };
  try {
    Scene scene = ReadObjText(text.obj, kObjName, library, options);
    scene.name = arrays.name;
    for (std::string& warning : scene.warnings) warning = WithoutLines(warning, text, arrays.name);
    return scene;
  } catch (const InputError& error) {
    throw InputError(WithoutLines(error.what(), text, arrays.name));
  }
}

}  // namespace penumbra
