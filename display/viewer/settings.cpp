#include "display/viewer/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "solver/base/check.h"

namespace penumbra::viewer {

double NumberFrom(const std::string& text, double low, double high) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= low && value <= high))
    throw InputError(fmt::format("'{}' is not a number from {} to {}", text, low, high));
  return value;
}

std::string TextOf(double number) { return fmt::format("{}", number); }

Setting& Settings::Add(Setting setting) {
  PENUMBRA_CHECK(Find(setting.name) == nullptr);
  all_.push_back(std::move(setting));
  return all_.back();
}

const Setting* Settings::Find(const std::string& name) const {
  const auto found = std::find_if(all_.begin(), all_.end(), [&](const Setting& s) { return s.name == name; });
  return found == all_.end() ? nullptr : &*found;
}

Setting& Settings::Toggle(const std::string& name, const std::string& group, const std::string& help,
                          bool* value) {
  return Toggle(
      name, group, help, [value] { return *value; }, [value](bool on) { *value = on; });
}

Setting& Settings::Toggle(const std::string& name, const std::string& group, const std::string& help,
                          std::function<bool()> get, std::function<void(bool)> set) {
  Setting setting{name, group, help, SettingKind::kToggle, 0, 1, false, false, {"off", "on"}, {}, {}};
  setting.get = [get = std::move(get)] { return get() ? "on" : "off"; };
  setting.set = [set = std::move(set)](const std::string& text) {
    if (text != "on" && text != "off") throw InputError(fmt::format("'{}' is neither on nor off", text));
    set(text == "on");
  };
  return Add(std::move(setting));
}

Setting& Settings::Number(const std::string& name, const std::string& group, const std::string& help,
                          double* value, const SliderRange& range) {
  const auto [low, high, logarithmic] = range;
  Setting setting{name, group, help, SettingKind::kNumber, low, high, logarithmic, false, {}, {}, {}};
  setting.get = [value] { return TextOf(*value); };
  setting.set = [value, range](const std::string& text) { *value = NumberFrom(text, range.low, range.high); };
  return Add(std::move(setting));
}

Setting& Settings::Integer(const std::string& name, const std::string& group, const std::string& help,
                           int* value, int low, int high) {
  const double first = low, last = high;
  Setting setting{name, group, help, SettingKind::kInteger, first, last, false, false, {}, {}, {}};
  setting.get = [value] { return std::to_string(*value); };
  setting.set = [=](const std::string& text) {
    const double number = NumberFrom(text, first, last);
    if (number != std::floor(number)) throw InputError(fmt::format("'{}' is not a whole number", text));
    *value = static_cast<int>(number);
  };
  return Add(std::move(setting));
}

Setting& Settings::AddChoice(const std::string& name, const std::string& group, const std::string& help,
                             std::vector<std::string> choices, std::function<std::size_t()> get,
                             std::function<void(std::size_t)> set) {
  Setting setting{name, group, help, SettingKind::kChoice, 0, 1, false, false, choices, {}, {}};
  setting.get = [choices, get = std::move(get)] { return choices[get()]; };
  setting.set = [choices, set = std::move(set)](const std::string& text) {
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end())
      throw InputError(fmt::format("'{}' is none of {}", text, fmt::join(choices, ", ")));
    set(static_cast<std::size_t>(found - choices.begin()));
  };
  return Add(std::move(setting));
}

Setting& Settings::Vector(const std::string& name, const std::string& group, const std::string& help,
                          std::function<Vec3()> get, std::function<void(const Vec3&)> set) {
  Setting setting{name, group, help, SettingKind::kText, 0, 1, false, false, {}, {}, {}};
  setting.get = [get = std::move(get)] {
    const Vec3 v = get();
    return fmt::format("{},{},{}", v.x(), v.y(), v.z());
  };
  setting.set = [set = std::move(set)](const std::string& text) {
    Vec3 v;
    std::size_t begin = 0;
    for (int i = 0; i < 3; ++i) {
      const std::size_t comma = text.find(',', begin);
      if ((comma == text.npos) != (i == 2)) throw InputError(fmt::format("'{}' is not x,y,z", text));
      v[i] = NumberFrom(text.substr(begin, comma - begin), -1e12, 1e12);
      begin = comma + 1;
    }
    set(v);
  };
  return Add(std::move(setting));
}

}  // namespace penumbra::viewer
