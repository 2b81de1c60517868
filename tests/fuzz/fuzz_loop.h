// tests/fuzz/fuzz_loop.h
//
// Functions that all fuzzers share: a loop over seeded runs, each of which can be repeated alone, and random
// changes to valid texts.

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "solver/base/random.h"

namespace penumbra::fuzz {

// Loop() calls `run` many times, each time with a differently seeded random generator. The command line of a
// fuzzer is PROGRAM [RUNS [SEED [FIRST]]], with the number of runs, the seed and the number of the first run.
// If a run of a fuzzer crashes or takes longer than kLongestRun, the program prints the number N of the run.
// The command PROGRAM 1 SEED N repeats the run with the number N. Loop() returns the exit status of the
// program.
int Loop(int argc, char** argv, std::uint64_t runs, const std::function<void(Random&)>& run);

// The longest time that all threads of a fuzzer may work for one run [s]. Even with sanitizers, a run of a
// fuzzer normally takes a few milliseconds.
inline constexpr unsigned kLongestRun = 60;

// Prints the text `what`, which says what is wrong, and ends the program.
[[noreturn]] void Fail(const std::string& what);

template <class Choices>
const auto& Pick(const Choices& choices, Random& random) {
  return choices[random.Index(static_cast<std::uint32_t>(std::size(choices)))];
}

// Returns a random number as a text, in a valid or a malformed notation.
std::string NumberText(Random& random);

// Returns the text after random changes of bytes, words, numbers and lines. The changes by Mutated() insert,
// replace, delete, repeat or move parts of the text, take words from `dictionary`, or cut the text off.
std::string Mutated(std::string text, std::span<const std::string_view> dictionary, Random& random);

// Ends the program unless the error message is a single line of moderate length that names the file and
// contains no control characters.
void CheckMessage(std::string_view message, std::string_view file);

}  // namespace penumbra::fuzz
