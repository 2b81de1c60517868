// Reads solution files that were valid and were then changed: those whose digest tells of it are refused, and
// those whose digest was made to fit are refused, or hold a solution that can be looked at. Either is told in
// one line that names the file.
//
//   solution_fuzz [RUNS=200 [SEED=1 [FIRST=0]]]

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "mesh/interpolants/triangle_quality.h"
#include "mesh/pipeline/pipeline.h"
#include "mesh/pipeline/solution_file.h"
#include "solver/base/check.h"
#include "solver/base/sha256.h"
#include "solver/scene/obj_reader.h"
#include "tests/fuzz/fuzz_loop.h"

namespace penumbra::fuzz {
namespace {

PipelineOptions Rough() {
  PipelineOptions options;
  options.error = 0.5;
  options.max_corrections = 1;
  options.error_points = 0;
  return options;
}

// A lamp over a floor with a block between them: every table has rows.
const std::string& Valid() {
  static const std::string bytes = [] {
    const Scene scene = ReadObjText(
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .2 .2 1\nv .8 .2 1\nv .8 .8 1\nv .2 .8 1\n"
        "v .4 .4 .5\nv .6 .4 .5\nv .6 .6 .5\nusemtl grey\nf 1 2 3 4\nf 9 11 10\nusemtl lamp\nf 5 8 7 6\n",
        "a.obj", [](std::string_view) { return "newmtl grey\nKd .5\nnewmtl lamp\nKd 0\nKe 1\n"; }, {});
    Pipeline pipeline(scene, Rough());
    pipeline.Solve({});
    pipeline.RefineLight({});
    pipeline.BuildMesh(MeshKind::kInterpolant, {});
    return EncodeSolution(pipeline, "{}", "{}", "1.2.3");
  }();
  return bytes;
}

// Corrects the digest, as no accident does.
void MakeDigestFit(std::string& bytes) {
  constexpr std::size_t kDigits = 64;
  const std::size_t at = bytes.find("sha256 ") + 7;
  if (at + kDigits > bytes.size()) return;
  bytes.replace(at, kDigits, std::string(kDigits, '0'));
  bytes.replace(at, kDigits, Sha256().Update(bytes).Finish());
}

// Writes a number of a random kind at a random place.
void WriteNumber(std::string& bytes, std::size_t at, Random& random) {
  constexpr double kDoubles[] = {std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity(),
                                 -1,
                                 0,
                                 1e300,
                                 4.9e-324,
                                 0.5};
  constexpr std::int32_t kIntegers[] = {-1,
                                        0,
                                        1,
                                        2,
                                        7,
                                        1000,
                                        std::numeric_limits<std::int32_t>::max(),
                                        std::numeric_limits<std::int32_t>::min()};
  const auto put = [&](const auto& value) {
    if (at + sizeof(value) <= bytes.size()) std::memcpy(bytes.data() + at, &value, sizeof(value));
  };
  if (random.Index(2) == 0)
    put(Pick(kDoubles, random));
  else
    put(Pick(kIntegers, random));
}

std::string Changed(Random& random) {
  std::string bytes = Valid();
  for (std::uint32_t changes = 1 + random.Index(4); changes > 0; --changes) {
    const std::size_t at = random.Index(static_cast<std::uint32_t>(bytes.size()));
    switch (random.Index(8)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.Index(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random.Index(256));
        break;
      case 2:
        if (random.Index(4) == 0) bytes.resize(at + 1);
        break;
      case 3:
        if (random.Index(4) == 0) bytes.insert(at, random.Index(100), static_cast<char>(random.Index(256)));
        break;
      default:
        // Numbers of tables lie at multiples of their size.
        WriteNumber(bytes, at / 8 * 8 + 4 * random.Index(2), random);
    }
  }
  return bytes;
}

// What every command does with a solution.
void LookAt(StoredSolution stored) {
  MeasureQuality(stored.state.mesh);
  const Pipeline pipeline(*stored.scene, Rough(), std::move(stored.state));
  for (std::size_t p = 0; p < pipeline.scene().patches.size(); ++p) {
    const Patch& patch = pipeline.scene().patches[p];
    const Vec3 middle = (patch.vertex[0] + patch.vertex[1] + patch.vertex[2]) / 3;
    const auto value =
        pipeline.Interpolated(static_cast<PatchId>(p), middle, 1e-6 * Diameter(patch.Vertices()));
    if (value && !value->isFinite().all()) Fail("an interpolant is not finite");
  }
}

void Run(Random& random) {
  std::string bytes = Changed(random);
  const bool fits = random.Index(4) > 0;
  if (fits) MakeDigestFit(bytes);
  try {
    StoredSolution stored = DecodeSolution(bytes, "a.h5");
    if (!fits && bytes != Valid()) Fail("a damaged file was taken");
    LookAt(std::move(stored));
  } catch (const InputError& error) {
    CheckMessage(error.what(), "a.h5: error: ");
  }
}

}  // namespace
}  // namespace penumbra::fuzz

int main(int argc, char** argv) { return penumbra::fuzz::Loop(argc, argv, 200, &penumbra::fuzz::Run); }
