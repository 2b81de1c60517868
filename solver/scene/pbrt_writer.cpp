#include "solver/scene/pbrt_writer.h"

#include <fmt/format.h>

#include <numbers>
#include <vector>

namespace penumbra {
namespace {

constexpr int kFilmWidth = 1280, kFilmHeight = 960;  // what pbrt draws [pixels]

std::string Triple(const auto& v) { return fmt::format("{} {} {}", v[0], v[1], v[2]); }

// A name between quotation marks, as a comment may hold it too.
std::string Quotable(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\') c = '_';
  return name;
}

// The patches of one object and material as one mesh. Counter-clockwise triangles face forward in pbrt, too:
// its normal is (p0 - p2) x (p1 - p2), and no transformation swaps it.
std::string MeshShape(const Scene& scene, const std::vector<const Patch*>& patches) {
  std::string points, indices;
  int first = 0;
  for (const Patch* patch : patches) {
    for (const Vec3& v : patch->Vertices()) points += "    " + Triple(v) + "\n";
    for (int k = 2; k < patch->size; ++k)
      indices += fmt::format("    {} {} {}\n", first, first + k - 1, first + k);
    first += patch->size;
  }
  const Rgb& emittance = scene.materials[static_cast<std::size_t>(patches[0]->material)].emittance;
  std::string text = "AttributeBegin\n";
  text += fmt::format("  NamedMaterial \"{}\"\n", patches[0]->material);
  if ((emittance > 0).any())
    text += fmt::format("  AreaLightSource \"diffuse\" \"rgb L\" [ {} ] \"bool twosided\" false\n",
                        Triple(Rgb(emittance / std::numbers::pi)));
  text += "  Shape \"trianglemesh\"\n  \"point3 P\" [\n" + points + "  ]\n  \"integer indices\" [\n" +
          indices + "  ]\nAttributeEnd\n";
  return text;
}

class PbrtWriter final : public SceneWriter {
 public:
  bool HasCamera() const override { return true; }
  std::vector<std::string> Texts(const Scene& scene, const Camera& camera,
                                 const std::string&) const override {
    return {PbrtText(scene, camera, kFilmWidth, kFilmHeight)};
  }
};

}  // namespace

std::string PbrtText(const Scene& scene, const Camera& camera, int width, int height) {
  // pbrt's camera is left-handed: without the mirror the picture would be one.
  std::string text =
      fmt::format("# {}: lengths in metres, radiance in W/(m^2 sr)\nScale -1 1 1\nLookAt {}  {}  {}\n",
                  Quotable(scene.name), Triple(camera.eye), Triple(camera.look_at), Triple(camera.up));
  text += fmt::format("Camera \"perspective\" \"float fov\" {}\n", camera.vertical_fov);
  text += fmt::format(
      "Film \"rgb\" \"string filename\" \"{}.exr\" \"integer xresolution\" {} \"integer yresolution\" {}\n",
      Quotable(scene.name), width, height);
  text +=
      "Sampler \"zsobol\" \"integer pixelsamples\" 256\nIntegrator \"path\" \"integer maxdepth\" "
      "100\nWorldBegin\n";
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    text +=
        fmt::format("MakeNamedMaterial \"{}\" \"string type\" \"diffuse\" \"rgb reflectance\" [ {} ]  # {}\n",
                    m, Triple(scene.materials[m].reflectance), Quotable(scene.materials[m].name));
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    std::vector<std::vector<const Patch*>> by_material(scene.materials.size());
    for (const Patch& patch : scene.patches)
      if (patch.object == static_cast<std::int32_t>(o))
        by_material[static_cast<std::size_t>(patch.material)].push_back(&patch);
    for (const auto& patches : by_material)
      if (!patches.empty())
        text += fmt::format("# {}\n", Quotable(scene.objects[o].name)) + MeshShape(scene, patches);
  }
  return text;
}

SceneWriterRegistry::Method PbrtWriterMethod() {
  return {"pbrt", "pbrt 4, with the camera; area lights of radiance emittance/pi", {}, [] {
            return std::make_unique<const PbrtWriter>();
          }};
}

}  // namespace penumbra
