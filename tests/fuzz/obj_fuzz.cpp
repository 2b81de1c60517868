// Reads OBJ files that were valid and were then changed, and others made by a grammar of the format, with all
// options of reading: each is a scene in which every number is finite, or is refused in one line.
//
//   obj_fuzz [RUNS=1000 [SEED=1 [FIRST=0]]]

#include <cmath>
#include <optional>

#include "solver/base/check.h"
#include "solver/scene/obj_reader.h"
#include "tests/fuzz/fuzz_loop.h"

namespace penumbra::fuzz {
namespace {

constexpr std::string_view kWords[] = {"v",
                                       "vt",
                                       "vn",
                                       "f",
                                       "g",
                                       "o",
                                       "s",
                                       "usemtl",
                                       "mtllib",
                                       "l",
                                       "p",
                                       "curv",
                                       "end",
                                       "#",
                                       "\\",
                                       "\\\n",
                                       "\n",
                                       "\r",
                                       "\r\n",
                                       "/",
                                       "//",
                                       "-",
                                       "f 1 2 3\n",
                                       " ",
                                       "\t",
                                       "red",
                                       "lamp",
                                       "a.mtl",
                                       "b.mtl",
                                       "off",
                                       "newmtl",
                                       "Kd",
                                       "\0",
                                       "\xff\xfe",
                                       "1/1/1",
                                       "-1//-1",
                                       "\"",
                                       "C:\\a.mtl",
                                       "v 0 0 0\n",
                                       "v 1 0 1e-7\n",
                                       "f 1 2 3 4 5 6 7 8\n",
                                       "ply\n"};

constexpr std::string_view kSamples[] = {
    "mtllib a.mtl\no room\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nusemtl red\nf 1 2 3 4\n"
    "usemtl lamp\nf 1 2 6 5\ng a b\nf 1 4 5\n",
    "# two flush lamps\nmtllib a.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 2 1 0\nv 2 2 0\nv 1 2 "
    "0\n"
    "usemtl red\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\nf -4 -3 -2\n",
    "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\nf 1 2 3 4 1 5 6 7 8 5\n",
    "v 0 0 0\nv 2 0 0.01\nv 2 2 0\nv 1 1 0.02\nv 0 2 0\nf 1/1/1 2//2 3/3 4 5\nf 1 2 3 5\nf 1 5 3 2\n",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"};

constexpr std::string_view kMtl = "newmtl red\nKd 0.5 0.25 0.125\nnewmtl lamp\nKd 0\nKe 1 2 3\n";

void AddVertices(std::string& text, Random& random) {
  // Points of a small grid, so that faces touch, repeat and cross; some beside it.
  for (std::uint32_t n = 3 + random.Index(12); n > 0; --n) {
    text += "v";
    for (int axis = 0; axis < 3; ++axis) {
      const bool odd = random.Index(40) == 0;
      const double off =
          random.Index(6) == 0 ? random.Uniform(-1, 1) * std::pow(10, -1.0 - random.Index(14)) : 0;
      text += " " + (odd ? NumberText(random)
                         : std::to_string(axis < 2 || random.Index(3) == 0 ? random.Index(4) : 0) +
                               (off > 0 ? std::to_string(off).substr(1) : ""));
    }
    text += "\n";
  }
}

void AddFace(std::string& text, Random& random) {
  text += "f";
  for (std::uint32_t n = 3 + random.Index(random.Index(4) == 0 ? 12 : 3); n > 0; --n) {
    const int index = static_cast<int>(random.Index(14)) - 2;
    text += " " + std::to_string(index);
    if (random.Index(8) == 0) text += Pick(kWords, random);
  }
  text += "\n";
}

std::string FromGrammar(Random& random) {
  std::string text;
  if (random.Index(4) == 0) text += "mtllib a.mtl\n";
  AddVertices(text, random);
  for (std::uint32_t n = random.Index(10); n > 0; --n) {
    switch (random.Index(8)) {
      case 0:
        text += "usemtl " + std::string(Pick(kWords, random)) + "\n";
        break;
      case 1:
        text += "o " + std::string(Pick(kWords, random)) + "\n";
        break;
      case 2:
        AddVertices(text, random);
        break;
      default:
        AddFace(text, random);
    }
  }
  return text;
}

void CheckScene(const Scene& scene) {
  for (const std::string& warning : scene.warnings) CheckMessage(warning, "");
  for (const Patch& patch : scene.patches) {
    if (!(patch.area > 0) || !std::isfinite(patch.area) || !(std::abs(patch.normal.norm() - 1) < 1e-9))
      Fail("a patch has no area or no normal");
    for (const Vec3& v : patch.Vertices())
      if (!v.allFinite()) Fail("a patch has no place");
    if (patch.material < 0 || patch.material >= static_cast<std::int32_t>(scene.materials.size()))
      Fail("a patch has no material");
    if (patch.faces.empty()) Fail("a patch has no face");
  }
  for (const Material& material : scene.materials)
    if (!(material.reflectance >= 0).all() || !(material.reflectance < 1).all() ||
        !(material.emittance >= 0).all() || !material.emittance.isFinite().all())
      Fail("a material is none");
}

void Run(Random& random) {
  std::string text = random.Index(2) == 0 ? std::string(Pick(kSamples, random)) : FromGrammar(random);
  if (random.Index(8) > 0) text = Mutated(std::move(text), kWords, random);
  SceneOptions options;
  options.two_sided = random.Index(4) == 0;
  options.strict = random.Index(8) == 0;
  options.emission_is_radiance = random.Index(8) == 0;
  if (random.Index(8) == 0) options.max_reflectance = 0.5;
  const MtlSource source = [](std::string_view name) -> std::optional<std::string> {
    return name == "a.mtl" ? std::optional<std::string>(kMtl) : std::nullopt;
  };
  try {
    CheckScene(ReadObjText(text, "scene.obj", source, options));
  } catch (const InputError& error) {
    CheckMessage(error.what(), "");
  }
}

}  // namespace
}  // namespace penumbra::fuzz

int main(int argc, char** argv) { return penumbra::fuzz::Loop(argc, argv, 1000, &penumbra::fuzz::Run); }
