#include "mesh/pipeline/option_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// The shortest text of the number, with short exponents: 1e100, 1e-6.
std::string BoundText(double number) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  const std::string text(buffer.data(), end);
  const std::size_t e = text.find('e');
  if (e == text.npos) return text;
  const std::size_t digits = text.find_first_not_of("+-0", e + 1);
  return text.substr(0, e + 1) + (text[e + 1] == '-' ? "-" : "") + text.substr(digits);
}

std::optional<OptionValue> ReadValue(const OptionField& field, const std::string& text) {
  switch (field.kind) {
    case OptionKind::kNumber: {
      const std::optional<double> number = ToNumber(text);
      if (number && field.numbers.Holds(*number)) return *number;
      break;
    }
    case OptionKind::kInteger: {
      std::uint64_t n = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
      if (error == std::errc() && end == text.data() + text.size() && field.integers.Holds(n)) return n;
      break;
    }
    case OptionKind::kFlag:
    case OptionKind::kChoice: {
      const std::vector<std::string> words = field.choices();
      const auto found = std::find(words.begin(), words.end(), text);
      if (found == words.end()) break;
      if (field.kind == OptionKind::kFlag) return found != words.begin();
      return text;
    }
  }
  return std::nullopt;
}

}  // namespace

std::string AllowedValues(const OptionField& field) {
  switch (field.kind) {
    case OptionKind::kNumber:
      return fmt::format("{}a number from {} to {}", field.numbers.or_zero ? "0, or " : "",
                         BoundText(field.numbers.low), BoundText(field.numbers.high));
    case OptionKind::kInteger:
      return fmt::format("{} from {} to {}", field.integers.powers_of_two ? "a power of two" : "an integer",
                         field.integers.low, field.integers.high);
    case OptionKind::kFlag:
    case OptionKind::kChoice:
      break;
  }
  return fmt::format("one of {}", fmt::join(field.choices(), "|"));
}

OptionValue ParseValue(const OptionField& field, std::string_view text) {
  const std::optional<OptionValue> value = ReadValue(field, std::string(text));
  if (!value) throw InputError(fmt::format("'{}' is not {}", text, AllowedValues(field)));
  return *value;
}

std::string ValueText(const OptionField& field, const OptionValue& value) {
  switch (field.kind) {
    case OptionKind::kFlag:
      return field.choices()[std::get<bool>(value) ? 1 : 0];
    case OptionKind::kInteger:
      return std::to_string(std::get<std::uint64_t>(value));
    case OptionKind::kNumber:
      return fmt::format("{}", std::get<double>(value));
    case OptionKind::kChoice:
      break;
  }
  return std::get<std::string>(value);
}

}  // namespace penumbra
