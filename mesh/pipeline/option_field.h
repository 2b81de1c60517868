// mesh/pipeline/option_field.h
//
// A field describes one option of a solve: the type and range of its value, and the place of the value in
// PipelineOptions.

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

// OptionValue holds the value of any option. The value of an option of the kind kChoice is a name.
using OptionValue = std::variant<bool, std::uint64_t, double, std::string>;

// The alternatives of the variant OptionValue, in the same order.
enum class OptionKind : std::uint8_t { kFlag, kInteger, kNumber, kChoice };

struct OptionField {
  OptionKind kind = OptionKind::kFlag;
  bool optional = false;  // true if the option may be omitted; its value then follows from other options
  NumberRange numbers;    // the permitted values of an option whose value is a real number
  IntegerRange integers;  // the permitted values of an option whose value is an integer
  // Returns the names of the values of an option of the kind kChoice, or the two words for the values of an
  // option of the kind kFlag.
  std::function<std::vector<std::string>()> choices;
  // Returns the value of the option, or nullopt if the option is not set, or if the chosen solver does not
  // have the option.
  std::function<std::optional<OptionValue>(const PipelineOptions&)> get;
  // Sets the value of the option; nullopt removes the value of an optional option. REQUIRES: the value is of
  // the type `kind`, or nullopt if `optional` is true, and the chosen solver has the option.
  std::function<void(const std::optional<OptionValue>&, PipelineOptions*)> set;
};

// Returns a description of the allowed values that completes a message "'TEXT' is not ...", for example "a
// number from 1e-6 to 10".
std::string AllowedValues(const OptionField& field);
// Converts the complete text to the value of an option. Throws InputError if the text is not an allowed
// value, for example "'TEXT' is not a number from 1e-6 to 10".
OptionValue ParseValue(const OptionField& field, std::string_view text);
// Converts the value of an option to a text that ParseValue() converts back to the value.
std::string ValueText(const OptionField& field, const OptionValue& value);

// The following functions make objects of type OptionField. `place` is a pointer to a member of
// PipelineOptions, or a function from PipelineOptions& (const or not) to a reference. The member or reference
// to which `place` leads is a value or an optional value.

template <class Type>
inline constexpr bool kIsOptional = false;
template <class Type>
inline constexpr bool kIsOptional<std::optional<Type>> = true;
// HeldValue<Type>::type is the type of the value that an optional holds, or Type itself if Type is no
// optional.
template <class Type>
struct HeldValue {
  using type = Type;
};
template <class Type>
struct HeldValue<std::optional<Type>> {
  using type = Type;
};

// Makes the OptionField of the option at `place`. `to_value` and `from_value` convert between OptionValue and
// the type of the member at `place`.
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

// Makes the OptionField of an option of type bool. `off` and `on` are the words for the values false and true
// of the option.
template <class Place>
OptionField FlagField(Place place, const char* off = "off", const char* on = "on") {
  OptionField field = MakeField(
      OptionKind::kFlag, place, [](bool held) { return OptionValue(held); },
      [](const OptionValue& value) { return std::get<bool>(value); });
  field.choices = [off, on] { return std::vector<std::string>{off, on}; };
  return field;
}

// Makes the OptionField of an option of type double.
template <class Place>
OptionField NumberField(Place place, NumberRange range) {
  OptionField field = MakeField(
      OptionKind::kNumber, place, [](double held) { return OptionValue(held); },
      [](const OptionValue& value) { return std::get<double>(value); });
  field.numbers = range;
  return field;
}

// Makes the OptionField of an option of an integer type. The type of the option's member must be able to
// represent all integers of the range.
template <class Place>
OptionField IntegerField(Place place, IntegerRange range) {
  using Held = typename HeldValue<std::remove_cvref_t<std::invoke_result_t<Place, PipelineOptions&>>>::type;
  OptionField field = MakeField(
      OptionKind::kInteger, place, [](Held held) { return OptionValue(static_cast<std::uint64_t>(held)); },
      [](const OptionValue& value) { return static_cast<Held>(std::get<std::uint64_t>(value)); });
  field.integers = range;
  return field;
}

// A list of the values of an enum, each with its name.
template <class Enum>
using NamedValues = std::vector<std::pair<std::string, Enum>>;

// Returns the name of an enum value. REQUIRES: the list `values` contains the value.
template <class Enum>
std::string NameAmong(const NamedValues<Enum>& values, Enum value) {
  for (const auto& [name, named] : values)
    if (named == value) return name;
  PENUMBRA_CHECK(false);
  return {};
}

// Returns the enum value with the name `name`. Throws InputError if no enum value has this name.
template <class Enum>
Enum ValueAmong(const NamedValues<Enum>& values, const std::string& name) {
  for (const auto& [other, named] : values)
    if (other == name) return named;
  throw InputError("no such choice: " + name);
}

// Makes the OptionField of an option of an enum type.
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

// Makes the OptionField of an option whose value is the name of a method in a registry. The registry must
// outlive the OptionField.
template <class Place, class Methods>
OptionField NameField(Place place, const Methods& methods) {
  OptionField field = MakeField(
      OptionKind::kChoice, place, [](const std::string& held) { return OptionValue(held); },
      [&methods](const OptionValue& value) { return methods.Find(std::get<std::string>(value)).name; });
  field.choices = [&methods] { return methods.Names(); };
  return field;
}

}  // namespace penumbra
