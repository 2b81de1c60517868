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

#include "solver/base/check.h"
#include "solver/geometry/vec.h"

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

// The value of that name. Throws InputError if there is none.
template <class Value, std::size_t kCount>
Value ChoiceValue(const Choice<Value> (&choices)[kCount], const std::string& name) {
  for (const Choice<Value>& choice : choices)
    if (name == choice.name) return choice.value;
  throw InputError("no such choice: " + name);
}

// `NAME A|B|...`, one of the choices.
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
