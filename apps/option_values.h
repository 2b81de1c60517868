// apps/option_values.h
//
// Values on the command line: parsed completely, rounded correctly, and checked against their range. For an
// invalid value the parser prints one line that states the valid values, and ends.

#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "solver/base/check.h"
#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The number in the text; nullopt unless the whole text is one finite number.
std::optional<double> ParseNumber(std::string_view text);

// The three numbers of the text `x,y,z`; nullopt for any other text.
std::optional<Vec3> ParseVector(std::string_view text);

// The range of a number, and its description.
struct NumberRule {
  bool (*holds)(double);
  const char* words;
};
// Limits such that squares and products of valid numbers neither overflow nor underflow.
inline constexpr double kTiniest = 1e-100, kLargest = 1e100;
inline constexpr NumberRule kPositive{[](double x) { return x >= kTiniest && x <= kLargest; },
                                      "a number from 1e-100 to 1e100"};
inline constexpr NumberRule kEmittance{[](double x) { return x >= 0 && x <= kLargestEmittance; },
                                       "a number, 0 or more, up to 1e100"};
inline constexpr NumberRule kNonNegative{[](double x) { return x >= 0 && x <= kLargest; },
                                         "a number from 0 to 1e100"};
// The range of a relative error. The program computes light to about 1e-6 at best.
inline constexpr NumberRule kRelativeError{[](double x) { return x >= 1e-6 && x <= 10; },
                                           "a number from 1e-6 to 10"};

// The text "a, b and c"; for many names, the first names and the number of the others.
std::string NameList(const std::vector<std::string>& names);

// Adds the option `NAME X`, a number. The help shows the target's value as the default. For an optional
// target, `help` describes the default.
CLI::Option* AddNumber(CLI::App& app, const std::string& name, double* target, const NumberRule& rule,
                       const std::string& help);
CLI::Option* AddNumber(CLI::App& app, const std::string& name, std::optional<double>* target,
                       const NumberRule& rule, const std::string& help);

// Adds the option `NAME N`, an integer in [low, high]. Defined for int and std::uint64_t.
template <class Integer>
CLI::Option* AddInteger(CLI::App& app, const std::string& name, Integer* target, Integer low, Integer high,
                        const std::string& help);

// A named value.
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

// The value of the choice called `name`. Throws InputError if there is none.
template <class Value, std::size_t kCount>
Value ChoiceValue(const Choice<Value> (&choices)[kCount], const std::string& name) {
  for (const Choice<Value>& choice : choices)
    if (name == choice.name) return choice.value;
  throw InputError("no such choice: " + name);
}

// Adds the option `NAME A|B|...`, one of the choices. The target has the type of their values, or is an
// optional of it.
template <class Target, class Value, std::size_t kCount>
CLI::Option* AddChoice(CLI::App& app, const std::string& name, Target* target,
                       const Choice<Value> (&choices)[kCount], const std::string& help) {
  std::string names;
  for (const Choice<Value>& choice : choices) names += (names.empty() ? "" : "|") + std::string(choice.name);
  const auto read = [=, first = &choices[0]](const std::string& text) {
    for (const Choice<Value>* choice = first; choice != first + kCount; ++choice)
      if (text == choice->name) return void(*target = choice->value);
    throw CLI::ValidationError(name, "'" + text + "' is not one of " + names);
  };
  CLI::Option* option = app.add_option_function<std::string>(name, read, help)->type_name(names);
  if constexpr (std::is_same_v<Target, Value>) option->default_str(ChoiceName(choices, *target));
  return option;
}

struct VectorRule {
  bool (*holds)(const Vec3&);
  const char* words;
};
// The limit for coordinates of scenes: squares do not overflow in floats, nor cubes in doubles.
inline constexpr VectorRule kPoint{[](const Vec3& v) { return MaxAbs(v) <= 1e36; },
                                   "three numbers, x,y,z, each up to 1e36"};
inline constexpr VectorRule kDirection{[](const Vec3& v) { return MaxAbs(v) <= 1e36 && !v.isZero(0); },
                                       "a direction, x,y,z, of any length but 0"};

// Adds the option `NAME x,y,z`, three numbers.
CLI::Option* AddVector(CLI::App& app, const std::string& name, std::optional<Vec3>* target,
                       const VectorRule& rule, const std::string& help);

}  // namespace penumbra
