#include "solver/scene/mgf_writer.h"

#include <fmt/format.h>

#include "solver/scene/mgf_colour.h"

namespace penumbra {
namespace {

constexpr double kWhite = 1.0 / 3;  // the chromaticity of equal energy

// The lines that set a colour and how much of it there is.
std::string Amount(const char* keyword, const Rgb& rgb) {
  const Vec3 xyz = MgfXyz(rgb);
  const double sum = xyz.sum();
  const double x = sum > 0 ? xyz.x() / sum : kWhite, y = sum > 0 ? xyz.y() / sum : kWhite;
  return fmt::format("  c\n    cxy {} {}\n  {} {}\n", x, y, keyword, xyz.y());
}

// Names end at blanks.
std::string Word(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= 0x20) c = '_';
  return name.empty() ? "unnamed" : name;
}

class MgfWriter final : public SceneWriter {
 public:
  std::vector<std::string> Texts(const Scene& scene, const Camera&, const std::string&) const override {
    return {MgfText(scene)};
  }
};

}  // namespace

std::string MgfText(const Scene& scene) {
  std::string text = fmt::format("# {}: lengths in metres, emittance in W/m^2\n", Word(scene.name));
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    text += fmt::format("# {}\nm m{} =\n  sides 1\n", Word(material.name), m) +
            Amount("rd", material.reflectance);
    if ((material.emittance > 0).any()) text += Amount("ed", material.emittance);
  }
  std::size_t vertices = 0;
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    std::string faces;
    for (const Patch& patch : scene.patches) {
      if (patch.object != static_cast<std::int32_t>(o)) continue;
      std::string line = fmt::format("m m{}\nf", patch.material);
      for (const Vec3& v : patch.Vertices()) {
        faces += fmt::format("v v{} =\n  p {} {} {}\n", vertices, v.x(), v.y(), v.z());
        line += fmt::format(" v{}", vertices++);
      }
      faces += line + "\n";
    }
    if (!faces.empty()) text += fmt::format("o {}\n", Word(scene.objects[o].name)) + faces + "o\n";
  }
  return text;
}

SceneWriterRegistry::Method MgfWriterMethod() {
  return {"mgf", "Materials and Geometry Format, for RenderPark; one-sided polygons", {}, [] {
            return std::make_unique<const MgfWriter>();
          }};
}

}  // namespace penumbra
