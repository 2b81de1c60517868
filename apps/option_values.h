// apps/option_values.h
//
// Parses values on the command line. A value is accepted only if its whole text is valid. Numbers are
// converted to the nearest double and checked against the permitted range. If a value is outside the range,
// parsing ends with a one-line message that describes the range.

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

// Converts the complete text to a number; returns nullopt if the text is not a finite number.
std::optional<double> ParseNumber(std::string_view text);

// Converts a text of the form `x,y,z` to three numbers; returns nullopt if the text does not have this form.
std::optional<Vec3> ParseVector(std::string_view text);

// A rule for a number: the permitted range, and a description of the range for messages.
struct NumberRule {
  bool (*holds)(double);
  const char* words;
};
inline constexpr NumberRule kPositive{[](double x) { return x >= kTiniestOption && x <= kLargestOption; },
                                      "a number from 1e-100 to 1e100"};
inline constexpr NumberRule kEmittance{[](double x) { return x >= 0 && x <= kLargestEmittance; },
                                       "a number, 0 or more, up to 1e100"};

// Joins names to a phrase "a, b and c". For a long list of names, the phrase contains only the first names
// and the number of the other names.
std::string NameList(const std::vector<std::string>& names);

// Adds an option `NAME X` to the command line, where X is a number. The help shows the value of `target` as
// the default; if `target` is a std::optional, the text `help` must describe the default.
CLI::Option* AddNumber(CLI::App& app, const std::string& name, double* target, const NumberRule& rule,
                       const std::string& help);
CLI::Option* AddNumber(CLI::App& app, const std::string& name, std::optional<double>* target,
                       const NumberRule& rule, const std::string& help);

// Adds an option `NAME N` to the command line, where N is an integer in [low, high]. AddInteger() is
// instantiated for int and std::uint64_t.
template <class Integer>
CLI::Option* AddInteger(CLI::App& app, const std::string& name, Integer* target, Integer low, Integer high,
                        const std::string& help);

// One of the permitted values of an option, with the name that the user gives for it.
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

// Adds an option `NAME A|B|...` to the command line, whose value is one of `choices`. The help shows the
// value of `target` as the default.
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
// The permitted range of coordinates: squares of coordinates must not overflow in floats, nor cubes in
// doubles.
inline constexpr VectorRule kPoint{[](const Vec3& v) { return MaxAbs(v) <= 1e36; },
                                   "three numbers, x,y,z, each up to 1e36"};
inline constexpr VectorRule kDirection{[](const Vec3& v) { return MaxAbs(v) <= 1e36 && !v.isZero(0); },
                                       "a direction, x,y,z, of any length but 0"};

// Adds an option `NAME x,y,z` to the command line, where x, y and z are numbers.
CLI::Option* AddVector(CLI::App& app, const std::string& name, std::optional<Vec3>* target,
                       const VectorRule& rule, const std::string& help);

}  // namespace penumbra
