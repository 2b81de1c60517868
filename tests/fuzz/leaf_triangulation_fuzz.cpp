// Triangulates sets of discontinuities made from random bytes, and stops at the first mesh that is not whole.
// It has the entry point of libFuzzer, and a loop of its own:
//
//   leaf_triangulation_fuzz [RUNS=1000 [SEED=1]]

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "constraint_sets.h"

// NOLINTNEXTLINE: the name is libFuzzer's.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  penumbra::mesh_test::CheckSet(penumbra::mesh_test::SetFromBytes({data, size}));
  return 0;
}

#ifndef PENUMBRA_LIBFUZZER
int main(int argc, char** argv) {
  const std::uint64_t runs = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  constexpr std::uint32_t kMostBytes = 100;
  std::vector<std::uint8_t> bytes;
  for (std::uint64_t run = 0; run < runs; ++run) {
    // The run is told beforehand: a failing one is the last that was told, or some after it.
    if (run % 10000 == 0) {
      std::printf("seed %llu, run %llu\n", static_cast<unsigned long long>(seed),
                  static_cast<unsigned long long>(run));
      std::fflush(stdout);
    }
    penumbra::Random random(seed, run);
    bytes.resize(random.Index(kMostBytes));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.Index(256));
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%llu runs: every mesh is whole\n", static_cast<unsigned long long>(runs));
  return 0;
}
#endif
