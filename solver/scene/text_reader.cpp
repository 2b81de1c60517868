#include "solver/scene/text_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace penumbra {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// A # begins a comment at the start of a line or after a blank; within a word it is part of it.
std::string_view WithoutComment(std::string_view line) {
  for (std::size_t i = line.find('#'); i != std::string_view::npos; i = line.find('#', i + 1))
    if (i == 0 || kBlanks.find(line[i - 1]) != std::string_view::npos) return line.substr(0, i);
  return line;
}

// The bytes of the character of UTF-8 that the text begins with; 0 if it is a control character or no UTF-8.
std::size_t PrintableLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : byte(0) >= 0xc2 ? 2 : 0;
  if (length == 0 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) < 0x80 || byte(i) > 0xbf) return 0;
  return length;
}

// Of a number beyond the range of binary64: true if it is too small, not too large.
bool IsTiny(std::string_view word) {
  const std::size_t exponent = word.find_first_of("eE");
  if (exponent != std::string_view::npos) return exponent + 1 < word.size() && word[exponent + 1] == '-';
  return word.find_first_not_of("-+0") == word.find('.');
}

}  // namespace

InputError ErrorAt(std::string_view file, int line, std::string_view message) {
  return InputError(std::string(file) + ":" + std::to_string(line) + ": error: " + std::string(message));
}

std::string WarningAt(std::string_view file, int line, std::string_view message) {
  return std::string(file) + ":" + std::to_string(line) + ": warning: " + std::string(message);
}

std::string Quoted(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string quoted = "'";
  std::size_t i = 0;
  while (i < text.size() && quoted.size() <= kLongest) {
    const std::size_t length = PrintableLength(text.substr(i));
    quoted += length > 0 ? text.substr(i, length) : "?";
    i += std::max<std::size_t>(length, 1);
  }
  if (i < text.size()) quoted += "...";
  return quoted + "'";
}

std::string_view StatementReader::TakeLine() {
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++next_line_;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

bool StatementReader::Next() {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (next_line_ == 1 && rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  while (!rest_.empty()) {
    line_ = next_line_;
    statement_.clear();
    for (bool continued = true; continued;) {
      std::string_view line = TakeLine();
      line = WithoutComment(line);
      continued = line.ends_with('\\') && !rest_.empty();
      if (line.ends_with('\\')) line.remove_suffix(1);
      statement_.append(line);
      if (continued) statement_ += ' ';
    }
    const std::string_view trimmed = Trimmed(statement_);
    if (trimmed.empty()) continue;
    const std::size_t end = std::min(trimmed.find_first_of(kBlanks), trimmed.size());
    keyword_ = trimmed.substr(0, end);
    arguments_ = Trimmed(trimmed.substr(end));
    return true;
  }
  return false;
}

std::vector<std::string_view> StatementReader::Words() const {
  std::vector<std::string_view> words;
  std::string_view rest = arguments_;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(kBlanks), rest.size());
    words.push_back(rest.substr(0, end));
    rest.remove_prefix(end);
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
  }
  return words;
}

std::optional<double> ToNumber(std::string_view word) {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-' && digits[1] != '+') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range)
    value = std::copysign(IsTiny(digits) ? 0 : std::numeric_limits<double>::infinity(),
                          digits[0] == '-' ? -1 : 1);
  return value;
}

double StatementReader::Number(std::string_view word) const {
  const std::optional<double> value = ToNumber(word);
  if (!value) throw Error(Quoted(word) + " is not a number; write it like 1.5 or 2e-3");
  if (!std::isfinite(*value))
    throw Error(Quoted(word) + " is not finite, or too large for a double; give a finite number");
  return *value;
}

}  // namespace penumbra
