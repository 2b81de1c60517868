#include "solver/scene/obj_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <vector>

namespace penumbra {
namespace {

// A name that the reader takes as it is: one line, nothing to trim.
std::string Plain(std::string name, bool blanks_allowed) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 0x20 || (c == ' ' && !blanks_allowed)) c = '_';
  if (!name.empty() && name.front() == ' ') name.front() = '_';
  if (!name.empty() && (name.back() == ' ' || name.back() == '\\')) name.back() = '_';
  return name.empty() ? "unnamed" : name;
}

// Names that are plain and all different, each changed as little as that takes.
std::vector<std::string> PlainNames(const auto& named, const auto& blanks_allowed) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < named.size(); ++i) {
    std::string name = Plain(named[i].name, blanks_allowed(i));
    for (int k = 2; !taken.insert(name).second; ++k)
      name = fmt::format("{}_{}", Plain(named[i].name, blanks_allowed(i)), k);
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string> MaterialNames(const Scene& scene) {
  return PlainNames(scene.materials, [](std::size_t) { return true; });
}

// The objects of each face beside Face::object.
std::vector<std::vector<std::int32_t>> Groups(const Scene& scene) {
  std::vector<std::vector<std::int32_t>> groups(scene.faces.size());
  for (std::size_t o = 0; o < scene.objects.size(); ++o)
    for (const std::int32_t face : scene.objects[o].faces)
      if (scene.faces[static_cast<std::size_t>(face)].object != static_cast<std::int32_t>(o))
        groups[static_cast<std::size_t>(face)].push_back(static_cast<std::int32_t>(o));
  return groups;
}

// The numbers of the vertices, counted from 1; equal bits, equal number.
class VertexList {
 public:
  std::size_t NumberOf(const Vec3& v, std::string& text) {
    const std::array<std::uint64_t, 3> bits = {std::bit_cast<std::uint64_t>(v.x()),
                                               std::bit_cast<std::uint64_t>(v.y()),
                                               std::bit_cast<std::uint64_t>(v.z())};
    const auto [at, is_new] = number_.try_emplace(bits, number_.size() + 1);
    if (is_new) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
    return at->second;
  }

 private:
  std::map<std::array<std::uint64_t, 3>, std::size_t> number_;
};

class ObjWriter final : public SceneWriter {
 public:
  std::vector<std::string> FilesBeside(const std::string& path) const override {
    return {std::filesystem::path(path).replace_extension(".mtl").string()};
  }
  std::vector<std::string> Texts(const Scene& scene, const Camera&, const std::string& path) const override {
    const std::filesystem::path library = FilesBeside(path).front();
    return {MtlText(scene), ObjText(scene, library.filename().string())};
  }
};

}  // namespace

std::string ObjText(const Scene& scene, std::string_view mtl_name) {
  const std::vector<std::vector<std::int32_t>> groups = Groups(scene);
  std::vector<char> is_group(scene.objects.size(), 0);
  for (const auto& of_face : groups)
    for (const std::int32_t group : of_face) is_group[static_cast<std::size_t>(group)] = 1;
  const std::vector<std::string> materials = MaterialNames(scene),
                                 objects =
                                     PlainNames(scene.objects, [&](std::size_t i) { return !is_group[i]; });

  std::string text = fmt::format("mtllib {}\n", mtl_name);
  // The order of objects is that in which they are named first.
  for (const std::string& object : objects) text += fmt::format("o {}\n", object);
  VertexList vertices;
  std::int32_t object = -1, material = -1;
  std::vector<std::int32_t> group;
  for (std::size_t i = 0; i < scene.faces.size(); ++i) {
    const Face& face = scene.faces[i];
    if (face.object != object || groups[i] != group) {
      object = face.object;
      group = groups[i];
      text += fmt::format("o {}\n", objects[static_cast<std::size_t>(object)]);
      if (!group.empty()) text += "g";
      for (const std::int32_t g : group) text += fmt::format(" {}", objects[static_cast<std::size_t>(g)]);
      if (!group.empty()) text += "\n";
    }
    if (face.material != material) {
      material = face.material;
      text += fmt::format("usemtl {}\n", materials[static_cast<std::size_t>(material)]);
    }
    std::string line = "f";
    for (const Vec3& v : face.vertices) line += fmt::format(" {}", vertices.NumberOf(v, text));
    if (face.vertices.empty()) {
      const std::size_t nowhere = vertices.NumberOf(Vec3::Zero(), text);
      line += fmt::format(" {} {} {}", nowhere, nowhere, nowhere);
    }
    text += line + "\n";
  }
  return text;
}

std::string MtlText(const Scene& scene) {
  const std::vector<std::string> names = MaterialNames(scene);
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Rgb &kd = scene.materials[i].reflectance, &ke = scene.materials[i].emittance;
    text += fmt::format("newmtl {}\nKd {} {} {}\nKe {} {} {}\n", names[i], kd[0], kd[1], kd[2], ke[0], ke[1],
                        ke[2]);
  }
  return text;
}

SceneWriterRegistry::Method ObjWriterMethod() {
  return {"obj", "with an .mtl beside it; read again it is the same scene", {}, [] {
            return std::make_unique<const ObjWriter>();
          }};
}

}  // namespace penumbra
