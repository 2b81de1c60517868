// tests/fuzz/fuzz_loop.h
//
// What the fuzzers share: a loop over seeded runs, each of which can be repeated by itself, and changes to
// texts that were valid.

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "solver/base/random.h"

namespace penumbra::fuzz {

// Calls `run` with a generator of its own, for PROGRAM [RUNS [SEED [FIRST]]]. Where a run crashes or takes
// longer than kLongestRun, its number is told: PROGRAM 1 SEED NUMBER repeats it. Returns an exit status.
int Loop(int argc, char** argv, std::uint64_t runs, const std::function<void(Random&)>& run);

inline constexpr unsigned kLongestRun = 60;  // [s], of a few milliseconds' work under sanitizers

// Ends the program, with what is wrong.
[[noreturn]] void Fail(const std::string& what);

template <class Choices>
const auto& Pick(const Choices& choices, Random& random) {
  return choices[random.Index(static_cast<std::uint32_t>(std::size(choices)))];
}

// A number as somebody writes it, or tries to.
std::string NumberText(Random& random);

// The text after some changes: bytes, words of the dictionary, numbers, lines; cut off, repeated, exchanged.
std::string Mutated(std::string text, std::span<const std::string_view> dictionary, Random& random);

// Ends the program unless the message is one line that names the file, without control characters, and of a
// length that can be read.
void CheckMessage(std::string_view message, std::string_view file);

}  // namespace penumbra::fuzz
