// apps/option_values.h
//
// Values on the command line: read whole and correctly rounded, checked against what they may be. A value
// that may not be ends the parse with one line that says what may.

#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// The number that the whole text is; nothing if it is none, or not finite.
std::optional<double> ParseNumber(std::string_view text);

// What a number may be, with the words for it.
struct NumberRule {
  bool (*holds)(double);
  const char* words;
};
inline constexpr NumberRule kAnyNumber{[](double) { return true; }, "a number"};
inline constexpr NumberRule kPositive{[](double x) { return x > 0; }, "a number above 0"};
inline constexpr NumberRule kNonNegative{[](double x) { return x >= 0; }, "a number, 0 or more"};

// `NAME X`, a number; the default in the help is the target's value. A target that is optional has its
// default in the help text.
CLI::Option* AddNumber(CLI::App& app, const std::string& name, double* target, const NumberRule& rule,
                       const std::string& help);
CLI::Option* AddNumber(CLI::App& app, const std::string& name, std::optional<double>* target,
                       const NumberRule& rule, const std::string& help);

// `NAME N`, an integer in [low, high]. For int and std::uint64_t.
template <class Integer>
CLI::Option* AddInteger(CLI::App& app, const std::string& name, Integer* target, Integer low, Integer high,
                        const std::string& help);

// `NAME x,y,z`, three numbers.
CLI::Option* AddVector(CLI::App& app, const std::string& name, std::optional<Vec3>* target,
                       const std::string& help);

// A value and its word on the command line.
template <class Value>
struct NamedValue {
  const char* name;
  Value value;
};

// `NAME WORD`, one of the words; take(i) is called with the number of the one that was given.
CLI::Option* AddWord(CLI::App& app, const std::string& name, const std::vector<std::string>& words,
                     const std::string& help, const std::function<void(std::size_t)>& take);

// The same for values with names; the target is of their type, or optional.
template <class Target, class Value, std::size_t kSize>
CLI::Option* AddChoice(CLI::App& app, const std::string& name, Target* target,
                       const std::array<NamedValue<Value>, kSize>& values, const std::string& help) {
  std::vector<std::string> words;
  for (const NamedValue<Value>& value : values) words.emplace_back(value.name);
  return AddWord(app, name, words, help, [=](std::size_t i) { *target = values[i].value; });
}

// The value of that name; the first if there is none.
template <class Value, std::size_t kSize>
Value ValueOf(std::string_view name, const std::array<NamedValue<Value>, kSize>& values) {
  for (const NamedValue<Value>& named : values)
    if (named.name == name) return named.value;
  return values.front().value;
}

template <class Value, std::size_t kSize>
const char* NameOf(Value value, const std::array<NamedValue<Value>, kSize>& values) {
  for (const NamedValue<Value>& named : values)
    if (named.value == value) return named.name;
  return "";
}

}  // namespace penumbra
