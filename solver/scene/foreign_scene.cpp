#include "solver/scene/foreign_scene.h"

#include <stdexcept>

#include "solver/geometry/vec_bytes.h"

namespace penumbra {
namespace {

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
  ByteWriter writer;
  ForeignScene copy = scene;
  Transfer(writer, copy);
  return writer.Take();
}

ForeignScene DecodeForeignScene(std::string_view bytes) {
  ByteReader reader(bytes);
  ForeignScene scene;
  Transfer(reader, scene);
  CheckIndices(scene);
  return scene;
}

}  // namespace penumbra
