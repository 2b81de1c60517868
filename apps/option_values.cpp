#include "apps/option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <system_error>

#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// An option whose text goes to `read`, which says whether it is what it may be.
CLI::Option* AddRead(CLI::App& app, const std::string& name, const char* type, const std::string& words,
                     const std::string& help, const std::function<bool(const std::string&)>& read) {
  return app
      .add_option_function<std::string>(
          name,
          [=](const std::string& text) {
            if (!read(text)) throw CLI::ValidationError(name, fmt::format("'{}' is not {}", text, words));
          },
          help)
      ->type_name(type);
}

template <class Integer>
std::optional<Integer> ParseInteger(std::string_view text) {
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

template <class Target>
bool ReadNumber(const std::string& text, const NumberRule& rule, Target* target) {
  const std::optional<double> value = ParseNumber(text);
  if (!value || !rule.holds(*value)) return false;
  *target = *value;
  return true;
}

}  // namespace

std::optional<double> ParseNumber(std::string_view text) {
  const std::optional<double> value = ToNumber(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string NameList(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;
  const std::size_t shown = names.size() <= kMost + 1 ? names.size() : kMost;
  std::string list;
  for (std::size_t i = 0; i < shown; ++i)
    list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  if (shown < names.size()) list += fmt::format(" and {} more", names.size() - shown);
  return list;
}

std::optional<Vec3> ParseVector(std::string_view text) {
  Vec3 vector;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == text.npos) != (i == 2)) return std::nullopt;
    const std::optional<double> value = ParseNumber(text.substr(0, comma));
    if (!value) return std::nullopt;
    vector[i] = *value;
    if (i < 2) text.remove_prefix(comma + 1);
  }
  return vector;
}

CLI::Option* AddNumber(CLI::App& app, const std::string& name, double* target, const NumberRule& rule,
                       const std::string& help) {
  return AddRead(app, name, "X", rule.words, fmt::format("{}; {}", help, rule.words),
                 [=](const std::string& text) { return ReadNumber(text, rule, target); })
      ->default_str(fmt::format("{}", *target));
}

CLI::Option* AddNumber(CLI::App& app, const std::string& name, std::optional<double>* target,
                       const NumberRule& rule, const std::string& help) {
  return AddRead(app, name, "X", rule.words, fmt::format("{}; {}", help, rule.words),
                 [=](const std::string& text) { return ReadNumber(text, rule, target); });
}

template <class Integer>
CLI::Option* AddInteger(CLI::App& app, const std::string& name, Integer* target, Integer low, Integer high,
                        const std::string& help) {
  const auto read = [=](const std::string& text) {
    const std::optional<Integer> value = ParseInteger<Integer>(text);
    if (!value || *value < low || *value > high) return false;
    *target = *value;
    return true;
  };
  const std::string words = fmt::format("an integer from {} to {}", low, high);
  return AddRead(app, name, "N", words, fmt::format("{}; {}", help, words), read)
      ->default_str(fmt::format("{}", *target));
}
template CLI::Option* AddInteger(CLI::App&, const std::string&, int*, int, int, const std::string&);
template CLI::Option* AddInteger(CLI::App&, const std::string&, std::uint64_t*, std::uint64_t, std::uint64_t,
                                 const std::string&);

CLI::Option* AddVector(CLI::App& app, const std::string& name, std::optional<Vec3>* target,
                       const VectorRule& rule, const std::string& help) {
  const auto read = [=](const std::string& text) {
    const std::optional<Vec3> value = ParseVector(text);
    if (!value || !rule.holds(*value)) return false;
    *target = *value;
    return true;
  };
  return AddRead(app, name, "x,y,z", rule.words, help, read);
}

}  // namespace penumbra
