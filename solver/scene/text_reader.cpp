#include "solver/scene/text_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "solver/scene/file_format.h"

namespace penumbra {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// The bytes of the character of UTF-8 that the text begins with; 0 if it is no UTF-8, or no character that is
// shown: those that control terminals, end lines or turn the direction of writing.
std::size_t PrintableLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : byte(0) >= 0xc2 ? 2 : 0;
  if (length == 0 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) < 0x80 || byte(i) > 0xbf) return 0;
  if (byte(0) == 0xc2 && byte(1) < 0xa0) return 0;
  const bool turns = byte(0) == 0xe2 && ((byte(1) == 0x80 && byte(2) >= 0xa8 && byte(2) <= 0xae) ||
                                         (byte(1) == 0x81 && byte(2) >= 0xa6 && byte(2) <= 0xa9));
  return turns ? 0 : length;
}

// What a byte that is not shown is written as.
std::string Escape(char byte) {
  if (byte == '\n') return "\\n";
  if (byte == '\r') return "\\r";
  if (byte == '\t') return "\\t";
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto value = static_cast<unsigned char>(byte);
  return std::string("\\x") + kDigits[value / 16] + kDigits[value % 16];
}

// Of a number beyond the range of binary64: true if it is too small, not too large.
bool IsTiny(std::string_view word) {
  const std::size_t exponent = word.find_first_of("eE");
  if (exponent != std::string_view::npos) return exponent + 1 < word.size() && word[exponent + 1] == '-';
  return word.find_first_not_of("-+0") == word.find('.');
}

}  // namespace

std::string PlaceOf(std::string_view file, int line) {
  constexpr std::size_t kLongestPath = 1000;  // [bytes]
  return Printable(file, kLongestPath) + (line > 0 ? ":" + std::to_string(line) : "");
}

InputError ErrorAt(std::string_view file, int line, std::string_view message) {
  return InputError(PlaceOf(file, line) + ": error: " + std::string(message));
}

std::string WarningAt(std::string_view file, int line, std::string_view message) {
  return PlaceOf(file, line) + ": warning: " + std::string(message);
}

std::string Printable(std::string_view text, std::size_t longest) {
  std::string shown;
  std::size_t i = 0;
  while (i < text.size() && shown.size() < longest) {
    const std::size_t length = PrintableLength(text.substr(i));
    shown += length > 0 ? std::string(text.substr(i, length)) : Escape(text[i]);
    i += std::max<std::size_t>(length, 1);
  }
  return i < text.size() ? shown + "..." : shown;
}

std::string Quoted(std::string_view text) {
  constexpr std::size_t kLongest = 60;  // [bytes]
  return "'" + Printable(text, kLongest) + "'";
}

std::string QuotedList(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i)
    list += (i > 0 ? ", " : "") + Quoted(names[i]);
  if (names.size() > kNamed) list += " and " + std::to_string(names.size() - kNamed) + " more";
  return list;
}

void RefuseForeignFormat(std::string_view text, std::string_view file, std::string_view wanted) {
  if (const std::optional<ForeignFormat> format = FindForeignFormat(text))
    throw ErrorAt(file, 0, ForeignFormatMessage(*format, wanted));
}

LineReader::LineReader(std::string_view text) : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  line_feed_ = std::min(rest_.find('\n'), rest_.size());
}

std::string_view LineReader::Take() {
  std::size_t end = std::min(rest_.substr(0, line_feed_).find('\r'), line_feed_), next = end;
  while (next < line_feed_ && rest_[next] == '\r') ++next;
  if (next == line_feed_)
    next = std::min(next + 1, rest_.size());  // LF, or CR LF: what was translated twice has CR CR LF
  else if (next > end) {
    next = end + 1;
    if (cr_line_ == 0) cr_line_ = next_line_;
  }
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(next);
  // A search for each line would take time by the square of a text without line feeds.
  line_feed_ = next <= line_feed_ ? line_feed_ - next : std::min(rest_.find('\n'), rest_.size());
  ++next_line_;
  return line;
}

// The next statement goes to keyword_ and arguments_; false if the next line holds none.
bool StatementReader::TakeStatement() {
  line_ = lines_.NextLine();
  std::string_view statement = Trimmed(lines_.Take());
  if (statement.starts_with('#')) return false;
  if (statement.ends_with('\\')) {
    joined_.clear();
    for (bool continued = true; continued;) {
      continued = statement.ends_with('\\') && !lines_.AtEnd();
      if (statement.ends_with('\\')) statement.remove_suffix(1);
      joined_.append(statement);
      if (!continued) break;
      joined_ += ' ';
      statement = Trimmed(lines_.Take());
      if (statement.starts_with('#')) break;
    }
    statement = joined_;
  }
  statement = Trimmed(statement);
  const std::size_t end = std::min(statement.find_first_of(kBlanks), statement.size());
  keyword_ = statement.substr(0, end);
  arguments_ = Trimmed(statement.substr(end));
  return !statement.empty();
}

bool StatementReader::Next() {
  while (!lines_.AtEnd())
    if (TakeStatement()) return true;
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

std::vector<std::string_view> StatementReader::Values() const {
  std::vector<std::string_view> values = Words();
  values.erase(std::find_if(values.begin(), values.end(), [](auto word) { return word.starts_with('#'); }),
               values.end());
  return values;
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
