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

#include "mesh/pipeline/option_range.h"
#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The number that the whole text is; nothing if it is none, or not finite.
std::optional<double> ParseNumber(std::string_view text);

// The three numbers of `x,y,z`; nothing if the text is anything else.
std::optional<Vec3> ParseVector(std::string_view text);

// What a number may be, with the words for it.
struct NumberRule {
  bool (*holds)(double);
  const char* words;
};
inline constexpr NumberRule kPositive{[](double x) { return x >= kTiniestOption && x <= kLargestOption; },
                                      "a number from 1e-100 to 1e100"};
inline constexpr NumberRule kEmittance{[](double x) { return x >= 0 && x <= kLargestEmittance; },
                                       "a number, 0 or more, up to 1e100"};

// "a, b and c"; of many, the first and how many more.
std::string NameList(const std::vector<std::string>& names);

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

// A name and what it stands for.
template <class Value>
struct Choice {
  const char* name;
  Value value;
};
template <class Value, std::size_t kCount>
const char* ChoiceName(const Choice<Value> (&choices)[kCount], Value value) {
  for (const Choice<Value>& choice : choices)
    if (choice.value == value) return choice.name;
  return "";
}

// `NAME A|B|...`, one of the choices; the default in the help is the target's value.
template <class Value, std::size_t kCount>
CLI::Option* AddChoice(CLI::App& app, const std::string& name, Value* target,
                       const Choice<Value> (&choices)[kCount], const std::string& help) {
  std::string names;
  for (const Choice<Value>& choice : choices) names += (names.empty() ? "" : "|") + std::string(choice.name);
  const auto read = [=, first = &choices[0]](const std::string& text) {
    for (const Choice<Value>* choice = first; choice != first + kCount; ++choice)
      if (text == choice->name) return void(*target = choice->value);
    throw CLI::ValidationError(name, "'" + text + "' is not one of " + names);
  };
  return app.add_option_function<std::string>(name, read, help)
      ->type_name(names)
      ->default_str(ChoiceName(choices, *target));
}

struct VectorRule {
  bool (*holds)(const Vec3&);
  const char* words;
};
// As the coordinates of scenes: squares must not overflow in floats, nor cubes in doubles.
inline constexpr VectorRule kPoint{[](const Vec3& v) { return MaxAbs(v) <= 1e36; },
                                   "three numbers, x,y,z, each up to 1e36"};
inline constexpr VectorRule kDirection{[](const Vec3& v) { return MaxAbs(v) <= 1e36 && !v.isZero(0); },
                                       "a direction, x,y,z, of any length but 0"};

// `NAME x,y,z`, three numbers.
CLI::Option* AddVector(CLI::App& app, const std::string& name, std::optional<Vec3>* target,
                       const VectorRule& rule, const std::string& help);

}  // namespace penumbra
