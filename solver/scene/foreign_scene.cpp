#include "solver/scene/foreign_scene.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace penumbra {
namespace {

// Both archives visit the members of a scene in the same order, one to append them to bytes, the other to
// take them from bytes.
class BytesWriter {
 public:
  void Raw(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  std::size_t Count(std::size_t count) {
    Raw(&count, sizeof count);
    return count;
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class BytesReader {
 public:
  explicit BytesReader(std::string_view bytes) : rest_(bytes) {}

  void Raw(void* data, std::size_t size) {
    if (size > rest_.size()) throw std::runtime_error("the bytes of a scene end early");
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  // Every element takes at least a byte, so that a false count does not take much memory.
  std::size_t Count(std::size_t) {
    std::size_t count = 0;
    Raw(&count, sizeof count);
    if (count > rest_.size()) throw std::runtime_error("the bytes of a scene hold a false count");
    return count;
  }

 private:
  std::string_view rest_;
};

template <class Archive, class Number>
requires std::is_arithmetic_v<Number>
void Transfer(Archive& archive, Number& number) { archive.Raw(&number, sizeof number); }

template <class Archive>
void Transfer(Archive& archive, Vec3& v) {
  archive.Raw(v.data(), 3 * sizeof(double));
}

template <class Archive>
void Transfer(Archive& archive, Vec2& v) {
  archive.Raw(v.data(), 2 * sizeof(double));
}

template <class Archive>
void Transfer(Archive& archive, Rgb& colour) {
  archive.Raw(colour.data(), 3 * sizeof(double));
}

template <class Archive>
void Transfer(Archive& archive, std::string& text) {
  text.resize(archive.Count(text.size()));
  archive.Raw(text.data(), text.size());
}

template <class Archive>
void Transfer(Archive& archive, ForeignMaterial& material) {
  Transfer(archive, material.name);
  Transfer(archive, material.diffuse);
  Transfer(archive, material.emission);
  Transfer(archive, material.textured);
  Transfer(archive, material.transparent);
  Transfer(archive, material.two_sided);
}

template <class Archive>
void Transfer(Archive& archive, ForeignFace& face) {
  Transfer(archive, face.first);
  Transfer(archive, face.size);
  Transfer(archive, face.material);
  Transfer(archive, face.object);
}

template <class Archive, class Element>
void Transfer(Archive& archive, std::vector<Element>& list) {
  list.resize(archive.Count(list.size()));
  for (Element& element : list) Transfer(archive, element);
}

template <class Archive>
void Transfer(Archive& archive, ForeignScene& scene) {
  Transfer(archive, scene.objects);
  Transfer(archive, scene.materials);
  Transfer(archive, scene.corners);
  Transfer(archive, scene.places);
  Transfer(archive, scene.faces);
  Transfer(archive, scene.rounding);
  Transfer(archive, scene.lights);
  Transfer(archive, scene.lines_and_points);
  Transfer(archive, scene.cameras);
  Transfer(archive, scene.animations);
  Transfer(archive, scene.coloured_meshes);
  Transfer(archive, scene.files);
  Transfer(archive, scene.centimetres);
  Transfer(archive, scene.up);
}

void CheckIndices(const ForeignScene& scene) {
  const auto in = [](std::int32_t i, const auto& list) {
    return i >= 0 && static_cast<std::size_t>(i) < list.size();
  };
  if (scene.places.size() != scene.corners.size())
    throw std::runtime_error("a scene has other numbers of corners and of texture coordinates");
  for (const ForeignFace& face : scene.faces) {
    const bool fine =
        face.size >= 3 && in(face.first, scene.corners) &&
        static_cast<std::size_t>(face.size) <= scene.corners.size() - static_cast<std::size_t>(face.first) &&
        in(face.object, scene.objects) && (face.material == -1 || in(face.material, scene.materials));
    if (!fine) throw std::runtime_error("a face of a scene refers to what is not there");
  }
}

}  // namespace

std::string EncodeForeignScene(const ForeignScene& scene) {
  BytesWriter writer;
  ForeignScene copy = scene;
  Transfer(writer, copy);
  return writer.Take();
}

ForeignScene DecodeForeignScene(std::string_view bytes) {
  BytesReader reader(bytes);
  ForeignScene scene;
  Transfer(reader, scene);
  CheckIndices(scene);
  return scene;
}

}  // namespace penumbra
