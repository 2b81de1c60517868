// mesh/pipeline/option_field.h
//
// One option of a solve: what kind of value it has, what the value may be, and where PipelineOptions holds
// it.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "mesh/pipeline/option_range.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/check.h"

namespace penumbra {

// The value of any option; a choice is a name.
using OptionValue = std::variant<bool, std::uint64_t, double, std::string>;

// The alternatives of OptionValue, in their order.
enum class OptionKind : std::uint8_t { kFlag, kInteger, kNumber, kChoice };

struct OptionField {
  OptionKind kind = OptionKind::kFlag;
  bool optional = false;                              // it may be left out, and then follows from others
  NumberRange numbers;                                // what a number may be
  IntegerRange integers;                              // what an integer may be
  std::function<std::vector<std::string>()> choices;  // the names of a choice; the two words of a flag
  // The value. Nothing where the option was left out, or where the chosen solver has no place for it.
  std::function<std::optional<OptionValue>(const PipelineOptions&)> get;
  // Nothing leaves the option out. REQUIRES: the value is of the kind; it is there unless the option is
  // optional; the chosen solver has a place for it.
  std::function<void(const std::optional<OptionValue>&, PipelineOptions*)> set;
};

// What the value may be, in words that follow "is not": "a number from 1e-6 to 10".
std::string AllowedValues(const OptionField& field);
// The value that the whole text is. Throws InputError, "'TEXT' is not a number from 1e-6 to 10", if it is
// none or one that the option may not have.
OptionValue ParseValue(const OptionField& field, std::string_view text);
// The text that ParseValue() reads back as the value.
std::string ValueText(const OptionField& field, const OptionValue& value);

// How fields are made. A `place` is a pointer to a member of PipelineOptions, or a function from
// PipelineOptions& (const or not) to a reference: to a value, or to an optional one.

template <class Type>
inline constexpr bool kIsOptional = false;
template <class Type>
inline constexpr bool kIsOptional<std::optional<Type>> = true;

// A field whose `to_value` and `from_value` turn what the place holds into an OptionValue and back.
template <class Place, class ToValue, class FromValue>
OptionField MakeField(OptionKind kind, Place place, ToValue to_value, FromValue from_value) {
  using Held = std::remove_cvref_t<std::invoke_result_t<Place, PipelineOptions&>>;
  OptionField field;
  field.kind = kind;
  field.optional = kIsOptional<Held>;
  field.get = [=](const PipelineOptions& from) -> std::optional<OptionValue> {
    const Held& held = std::invoke(place, from);
    if constexpr (kIsOptional<Held>)
      return held ? std::optional<OptionValue>(to_value(*held)) : std::nullopt;
    else
      return to_value(held);
  };
  field.set = [=](const std::optional<OptionValue>& value, PipelineOptions* to) {
    Held& held = std::invoke(place, *to);
    if constexpr (kIsOptional<Held>) {
      if (!value) return held.reset();
    }
    PENUMBRA_CHECK(value.has_value());
    held = from_value(*value);
  };
  return field;
}

// Of a bool. `off` and `on` are the words of its values.
template <class Place>
OptionField FlagField(Place place, const char* off = "off", const char* on = "on") {
  OptionField field = MakeField(
      OptionKind::kFlag, place, [](bool held) { return OptionValue(held); },
      [](const OptionValue& value) { return std::get<bool>(value); });
  field.choices = [off, on] { return std::vector<std::string>{off, on}; };
  return field;
}

// Of a double.
template <class Place>
OptionField NumberField(Place place, NumberRange range) {
  OptionField field = MakeField(
      OptionKind::kNumber, place, [](double held) { return OptionValue(held); },
      [](const OptionValue& value) { return std::get<double>(value); });
  field.numbers = range;
  return field;
}

// Of an integer type, which holds the whole range.
template <class Place>
OptionField IntegerField(Place place, IntegerRange range) {
  using Held = std::remove_cvref_t<std::invoke_result_t<Place, PipelineOptions&>>;
  OptionField field = MakeField(
      OptionKind::kInteger, place, [](Held held) { return OptionValue(static_cast<std::uint64_t>(held)); },
      [](const OptionValue& value) { return static_cast<Held>(std::get<std::uint64_t>(value)); });
  field.integers = range;
  return field;
}

// The values of an enum with their names.
template <class Enum>
using NamedValues = std::vector<std::pair<std::string, Enum>>;

// REQUIRES: the value has a name.
template <class Enum>
std::string NameAmong(const NamedValues<Enum>& values, Enum value) {
  for (const auto& [name, named] : values)
    if (named == value) return name;
  PENUMBRA_CHECK(false);
  return {};
}

// Throws InputError if there is no value of that name.
template <class Enum>
Enum ValueAmong(const NamedValues<Enum>& values, const std::string& name) {
  for (const auto& [other, named] : values)
    if (other == name) return named;
  throw InputError("no such choice: " + name);
}

// Of an enum.
template <class Place, class Enum>
OptionField ChoiceField(Place place, const NamedValues<Enum>& values) {
  OptionField field = MakeField(
      OptionKind::kChoice, place, [values](Enum held) { return OptionValue(NameAmong(values, held)); },
      [values](const OptionValue& value) { return ValueAmong(values, std::get<std::string>(value)); });
  field.choices = [values] {
    std::vector<std::string> names;
    for (const auto& [name, value] : values) names.push_back(name);
    return names;
  };
  return field;
}

// The name of a method in a registry, which must outlive the field.
template <class Place, class Methods>
OptionField NameField(Place place, const Methods& methods) {
  OptionField field = MakeField(
      OptionKind::kChoice, place, [](const std::string& held) { return OptionValue(held); },
      [&methods](const OptionValue& value) { return methods.Find(std::get<std::string>(value)).name; });
  field.choices = [&methods] { return methods.Names(); };
  return field;
}

}  // namespace penumbra
