// display/viewer/settings.h
//
// Everything that a user can set, by name: panels, menus and scripts all go through here.

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra::viewer {

enum class SettingKind {
  kToggle,   // on, off
  kNumber,   // from `low` to `high`; on a logarithmic slider if `logarithmic`
  kInteger,  // the same, whole
  kChoice,   // one of `choices`
  kText,     // anything
};

struct Setting {
  std::string name;   // as in `set NAME VALUE`
  std::string group;  // where panels show it
  std::string help;   // a few words; what panels call it
  SettingKind kind = SettingKind::kText;
  double low = 0, high = 1;
  bool logarithmic = false;
  bool automatic = false;  // `auto` is a value, too
  std::vector<std::string> choices;
  std::function<std::string()> get;
  // Throws InputError, a few words that say what may be, unless the value may.
  std::function<void(const std::string&)> set;
};

// In the order added; names are unique.
class Settings {
 public:
  Setting& Toggle(const std::string& name, const std::string& group, const std::string& help, bool* value);
  Setting& Number(const std::string& name, const std::string& group, const std::string& help, double* value,
                  double low, double high, bool logarithmic);
  Setting& Integer(const std::string& name, const std::string& group, const std::string& help, int* value,
                   int low, int high);
  // `value` is an enum whose values are the places of the choices.
  template <class Enum>
  Setting& Choice(const std::string& name, const std::string& group, const std::string& help, Enum* value,
                  std::vector<std::string> choices) {
    return AddChoice(
        name, group, help, std::move(choices), [value] { return static_cast<std::size_t>(*value); },
        [value](std::size_t i) { *value = static_cast<Enum>(i); });
  }
  // The same, with `auto` for nothing.
  template <class Enum>
  Setting& OptionalChoice(const std::string& name, const std::string& group, const std::string& help,
                          std::optional<Enum>* value, std::vector<std::string> choices) {
    choices.insert(choices.begin(), "auto");
    return AddChoice(
        name, group, help, std::move(choices),
        [value] { return *value ? static_cast<std::size_t>(**value) + 1 : 0; },
        [value](std::size_t i) { *value = i == 0 ? std::nullopt : std::optional(static_cast<Enum>(i - 1)); });
  }
  Setting& Vector(const std::string& name, const std::string& group, const std::string& help,
                  std::function<Vec3()> get, std::function<void(const Vec3&)> set);
  Setting& Add(Setting setting);

  // Null if there is none.
  const Setting* Find(const std::string& name) const;
  const std::vector<Setting>& all() const { return all_; }

 private:
  Setting& AddChoice(const std::string& name, const std::string& group, const std::string& help,
                     std::vector<std::string> choices, std::function<std::size_t()> get,
                     std::function<void(std::size_t)> set);

  std::vector<Setting> all_;
};

// The number that the whole text is. Throws InputError unless it is one from `low` to `high`.
double NumberFrom(const std::string& text, double low, double high);

// The shortest text that reads back as the number.
std::string TextOf(double number);

}  // namespace penumbra::viewer
