// display/viewer/settings.h
//
// All settings of the viewer that the user can change. Panels, menus and scripts access a setting by its
// name.

#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra::viewer {

enum class SettingKind {
  kToggle,   // the value is `on` or `off`
  kNumber,   // a number from `low` to `high`; the slider may be logarithmic
  kInteger,  // an integer from `low` to `high`
  kChoice,   // the value is one of the names in `choices`
  kText,     // the value is any text
};

struct Setting {
  std::string name;   // name of the setting, as in the script line `set NAME VALUE`
  std::string group;  // the name of the panel group that contains the setting
  std::string help;   // label of the setting in panels, in a few words
  SettingKind kind = SettingKind::kText;
  double low = 0, high = 1;
  bool logarithmic = false;
  bool automatic = false;  // if true, `auto` is also an allowed value
  std::vector<std::string> choices;
  std::function<std::string()> get;
  // Sets the value of the setting. Throws InputError, with a few words about the allowed values, if the value
  // is not allowed.
  std::function<void(const std::string&)> set;
};

// The range of a number setting, and the scale (linear or logarithmic) of its slider.
struct SliderRange {
  double low, high;
  bool logarithmic = false;
};

// A list of settings, in the order in which they were added. REQUIRES: all settings of the list have
// different names.
class Settings {
 public:
  Setting& Toggle(const std::string& name, const std::string& group, const std::string& help, bool* value);
  Setting& Toggle(const std::string& name, const std::string& group, const std::string& help,
                  std::function<bool()> get, std::function<void(bool)> set);
  Setting& Number(const std::string& name, const std::string& group, const std::string& help, double* value,
                  const SliderRange& range);
  Setting& Integer(const std::string& name, const std::string& group, const std::string& help, int* value,
                   int low, int high);
  // A list of pairs: the name of a choice, and its value.
  template <class Value>
  using Named = std::vector<std::pair<std::string, Value>>;

  // Adds a setting with a list of named choices. REQUIRES: `choices` has a name for every value that `value`
  // may have.
  template <class Value>
  Setting& Choice(const std::string& name, const std::string& group, const std::string& help, Value* value,
                  const Named<std::type_identity_t<Value>>& choices) {
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.first);
    const auto place = [value, choices] {
      const auto found = std::find_if(choices.begin(), choices.end(),
                                      [value](const auto& choice) { return choice.second == *value; });
      return static_cast<std::size_t>(found - choices.begin());
    };
    return AddChoice(name, group, help, std::move(names), place,
                     [value, choices](std::size_t i) { *value = choices[i].second; });
  }
  Setting& Vector(const std::string& name, const std::string& group, const std::string& help,
                  std::function<Vec3()> get, std::function<void(const Vec3&)> set);
  Setting& Add(Setting setting);

  // The setting with the given name; null if no setting has this name.
  const Setting* Find(const std::string& name) const;
  const std::vector<Setting>& all() const { return all_; }

 private:
  Setting& AddChoice(const std::string& name, const std::string& group, const std::string& help,
                     std::vector<std::string> choices, std::function<std::size_t()> get,
                     std::function<void(std::size_t)> set);

  std::vector<Setting> all_;
};

// Converts the complete text to a number. Throws InputError unless the text is a number from `low` to `high`.
double NumberFrom(const std::string& text, double low, double high);

// The shortest text that converts back to exactly the same number.
std::string TextOf(double number);

}  // namespace penumbra::viewer
