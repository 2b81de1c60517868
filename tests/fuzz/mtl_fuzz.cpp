// Reads material libraries that were valid and were then changed: each gives materials whose numbers are
// finite and in their range, or is refused in one line that names the file.
//
//   mtl_fuzz [RUNS=1000 [SEED=1 [FIRST=0]]]

#include <string>
#include <vector>

#include "solver/base/check.h"
#include "solver/scene/mtl_reader.h"
#include "tests/fuzz/fuzz_loop.h"

namespace penumbra::fuzz {
namespace {

constexpr std::string_view kWords[] = {"newmtl",
                                       "newmtl a\n",
                                       "Kd",
                                       "Ke",
                                       "Ka",
                                       "Ks",
                                       "Ns",
                                       "d",
                                       "Tr",
                                       "illum 2",
                                       "map_Kd -s 1 1 1 a.png",
                                       "spectral",
                                       "xyz",
                                       "#",
                                       " # ",
                                       "\\",
                                       "\\\n",
                                       "\n",
                                       "\r",
                                       "\r\n",
                                       " ",
                                       "\t",
                                       "\0",
                                       "Kd 0.5\n",
                                       "Ke 1 2 3\n",
                                       "-",
                                       "+",
                                       ".",
                                       "e",
                                       "nan",
                                       "inf",
                                       "1",
                                       "0.99",
                                       "\xef\xbb\xbf",
                                       "\xff\xfe",
                                       "C:\\textures\\a.png"};

constexpr std::string_view kSamples[] = {
    "newmtl red\nKd 0.5 0.25 0.125\nnewmtl lamp\nKd 0\nKe 1 2 3\n",
    "# Blender 3.6 MTL File: 'room.blend'\n# www.blender.org\n\nnewmtl Material.001\nNs 250.000000\nKa 1.0 "
    "1.0 1.0\n"
    "Kd 0.800000 0.800000 0.800000\nKs 0.5 0.5 0.5\nKe 0.0 0.0 0.0\nNi 1.45\nd 1.0\nillum 2\nmap_Kd tex\\a "
    "b.png\n",
    "\xef\xbb\xbfnewmtl Material #25\r\n\tNs 10.0\r\n\td 1.0\r\n\tTr 0.0\r\n\tTf 1 1 1\r\n\tillum 2\r\n\tKa "
    "0.588 0.588 "
    "0.588\r\n\tKd 0.588 0.588 0.588\r\n\tKs 0 0 0\r\n\tKe 0 0 0\r\nnewmtl Material #25\r\nKd 0.25\r\n"};

std::string FromGrammar(Random& random) {
  std::string text;
  for (std::uint32_t n = random.Index(12); n > 0; --n) {
    text += Pick(kWords, random);
    for (std::uint32_t k = random.Index(5); k > 0; --k)
      text += " " + (random.Index(4) > 0 ? NumberText(random) : std::string(Pick(kWords, random)));
    text += "\n";
  }
  return text;
}

void Run(Random& random) {
  std::string text = random.Index(2) == 0 ? std::string(Pick(kSamples, random)) : FromGrammar(random);
  text = Mutated(std::move(text), kWords, random);
  SceneOptions options;
  options.emission_is_radiance = random.Index(4) == 0;
  if (random.Index(2) == 0) options.max_reflectance = random.Uniform();
  try {
    std::vector<std::string> warnings;
    for (const DefinedMaterial& defined : ReadMtlText(text, "a.mtl", options, warnings)) {
      const Material& material = defined.material;
      if (defined.line < 1) Fail("a material has no line");
      if (!(material.reflectance >= 0).all() || !(material.reflectance < 1).all() ||
          !(material.emittance >= 0).all() || !material.emittance.isFinite().all())
        Fail("a material is none");
    }
    for (const std::string& warning : warnings) CheckMessage(warning, "a.mtl:");
  } catch (const InputError& error) {
    CheckMessage(error.what(), "a.mtl:");
  }
}

}  // namespace
}  // namespace penumbra::fuzz

int main(int argc, char** argv) { return penumbra::fuzz::Loop(argc, argv, 1000, &penumbra::fuzz::Run); }
