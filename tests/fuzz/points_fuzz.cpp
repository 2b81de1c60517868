// Reads lists of points that were valid and were then changed: each gives points whose numbers are finite, or
// is refused in one line that names the file.
//
//   points_fuzz [RUNS=1000 [SEED=1 [FIRST=0]]]

#include "apps/points_csv.h"
#include "solver/base/check.h"
#include "tests/fuzz/fuzz_loop.h"

namespace penumbra::fuzz {
namespace {

constexpr std::string_view kWords[] = {"x,y,z,nx,ny,nz\n",
                                       ",",
                                       ",,",
                                       ";",
                                       "\n",
                                       "\r",
                                       "\r\n",
                                       "\t",
                                       " ",
                                       "\"",
                                       "0,0,0,0,0,1\n",
                                       "nan",
                                       "inf",
                                       "#",
                                       "\0",
                                       "\xef\xbb\xbf",
                                       "\xff\xfe",
                                       "x",
                                       "nx",
                                       "{",
                                       "<",
                                       "PK\x03\x04",
                                       "1e",
                                       "e",
                                       "."};

constexpr std::string_view kSamples[] = {
    "x,y,z,nx,ny,nz\n0,0,0,0,0,1\n1.5,-2e-3,0.1,1,0,0\n",
    "\xef\xbb\xbfx, y, z, nx, ny, nz\r\n 0.5 , 0.5 , 1e-400 , 0 , 0 , -1 \r\n\r\n1,2,3,4,5,6\r\n",
    "x,y,z,nx,ny,nz\r1,2,3,0,0,1\r4,5,6,0,1,0\r"};

void Run(Random& random) {
  std::string text(Pick(kSamples, random));
  for (std::uint32_t n = random.Index(4); n > 0; --n) {
    for (int column = 0; column < 6; ++column) text += (column > 0 ? "," : "") + NumberText(random);
    text += "\n";
  }
  if (random.Index(8) > 0) text = Mutated(std::move(text), kWords, random);
  try {
    for (const ProbePoint& point : ReadPointsText(text, "p.csv"))
      if (!point.position.allFinite() || !point.normal.allFinite()) Fail("a point is none");
  } catch (const InputError& error) {
    CheckMessage(error.what(), "p.csv");
  }
}

}  // namespace
}  // namespace penumbra::fuzz

int main(int argc, char** argv) { return penumbra::fuzz::Loop(argc, argv, 1000, &penumbra::fuzz::Run); }
