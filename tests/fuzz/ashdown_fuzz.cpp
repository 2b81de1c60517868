// Reads entities of Ashdown's book that were valid and were then changed: each is refused in one line, or has
// patches whose corners, surfaces and numbers are there.
//
//   ashdown_fuzz [RUNS=1000 [SEED=1 [FIRST=0]]]

#include <string>
#include <string_view>

#include "solver/base/check.h"
#include "solver/scene/ashdown_entity.h"
#include "tests/fuzz/fuzz_loop.h"

namespace penumbra::fuzz {
namespace {

constexpr std::string_view kWords[] = {
    "ENTITY",      "VERTEX\n",    "END_VERT\n", "SURFACE\n",  "END_SURF\n",
    "PATCH\n",     "END_PATCH\n", "ELEMENT\n",  "END_ELEM\n", "END_ENTITY\n",
    "COMMENT",     "<",           ">",          "[",          "]",
    "{",           "}",           "(",          ")",          "\n",
    "\r",          "\r\n",        " ",          "\t",         "0 { 0 1 2 3 }\n",
    "< 0 0 0 >\n", "nan",         "-1",         "1e999",      "4294967296",
    "\0",          "\xff\xfe"};

constexpr std::string_view kSamples[] = {
    "ENTITY square\nVERTEX\n< 0 0 0 >\n< 1 0 0 >\n< 1 1 0 >\n< 0 1 0.5 >\nEND_VERT\nSURFACE\n[ .5 .5 .5 ] [ "
    "1 2 3 "
    "]\n[ 0 0 0 ] [ 0 0 0 ]\nEND_SURF\nPATCH\n0 { 0 1 2 3 }\n1 { 0 2 1 1 }\nEND_PATCH\nELEMENT\n0 { 0 1 2 2 "
    "}\n1 { 0 "
    "2 1 1 }\nEND_ELEM\nEND_ENTITY\n",
    "ENTITY\r\nCOMMENT one\r\nVERTEX\r\n(0 0 0)\r\n(1e-3 0 0)\r\n(0 2e5 0)\r\nEND\r\nSURFACE\r\n[1 0 0][0 0 "
    "0]\r\nEND\r\nPATCH\r\n0{0 1 2 2}\r\nEND\r\nELEMENT\r\n0{0 1 2 2}\r\nEND\r\n"};

void Run(Random& random) {
  std::string text(Pick(kSamples, random));
  if (random.Index(4) == 0) {
    const std::string vertex = "< " + NumberText(random) + " " + NumberText(random) + " 0 >\n";
    text.insert(text.find('\n', text.find("VERTEX")) + 1, vertex);
  }
  if (random.Index(8) > 0) text = Mutated(std::move(text), kWords, random);
  try {
    const AshdownEntity entity = ReadAshdownEntity(text, "e.ent");
    if (entity.surfaces.empty() || entity.patches.empty() || entity.elements == 0 || entity.vertices == 0)
      Fail("a section is empty");
    if (!entity.step.allFinite() || !(entity.step.array() >= 0).all()) Fail("the rounding is none");
    for (const AshdownEntity::Patch& patch : entity.patches) {
      if (patch.surface >= entity.surfaces.size()) Fail("a patch has no surface");
      if (patch.corners.size() != 3 && patch.corners.size() != 4) Fail("a patch has no corners");
      for (const Vec3& corner : patch.corners)
        if (!corner.allFinite()) Fail("a corner is none");
    }
  } catch (const InputError& error) {
    CheckMessage(error.what(), "e.ent");
  }
}

}  // namespace
}  // namespace penumbra::fuzz

int main(int argc, char** argv) { return penumbra::fuzz::Loop(argc, argv, 1000, &penumbra::fuzz::Run); }
