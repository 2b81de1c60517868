#include "solver/scene/rad_text.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

class RadLexer {
 public:
  RadLexer(std::string_view text, std::string_view file) : rest_(text), file_(file) {}

  // Skips blanks and comments; false at the end of the text.
  bool More() {
    while (!rest_.empty()) {
      if (rest_[0] == '#')
        Drop(std::min(rest_.find('\n'), rest_.size()));
      else if (IsBlank(rest_[0]))
        Drop(1);
      else
        return true;
    }
    return false;
  }
  char Next() const { return rest_[0]; }
  int Line() const { return line_; }

  std::string_view Word() {
    if (!More()) throw ErrorAt(file_, begin_, "the text ends in this primitive; complete it");
    std::size_t end = 0;
    while (end < rest_.size() && !IsBlank(rest_[end])) ++end;
    const std::string_view word = rest_.substr(0, end);
    Drop(end);
    return word;
  }

  // The words of a line; a backslash at its end joins the next line.
  std::vector<std::string> CommandWords() {
    std::vector<std::string> words;
    Drop(1);
    while (!rest_.empty() && rest_[0] != '\n') {
      if (rest_.starts_with("\\\n") || IsBlank(rest_[0])) {
        Drop(rest_[0] == '\\' ? 2 : 1);
        continue;
      }
      std::size_t end = 0;
      while (end < rest_.size() && !IsBlank(rest_[end]) && !rest_.substr(end).starts_with("\\\n")) ++end;
      words.emplace_back(rest_.substr(0, end));
      Drop(end);
    }
    return words;
  }

  void Begin() { begin_ = line_; }
  InputError Error(const std::string& message) const { return ErrorAt(file_, line_, message); }

 private:
  void Drop(std::size_t count) {
    for (const char c : rest_.substr(0, count)) line_ += c == '\n' ? 1 : 0;
    rest_.remove_prefix(count);
  }

  std::string_view rest_;
  std::string file_;
  int line_ = 1, begin_ = 1;  // begin_: of the primitive
};

int CountAt(RadLexer& lexer) {
  const std::string_view word = lexer.Word();
  int count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (error != std::errc() || end != word.data() + word.size() || count < 0)
    throw lexer.Error(Quoted(word) + " is no number of arguments; give an integer, 0 or more");
  return count;
}

RadPrimitive PrimitiveAt(RadLexer& lexer) {
  RadPrimitive primitive;
  lexer.Begin();
  primitive.line = lexer.Line();
  if (lexer.Next() == '!') {
    primitive.type = "!";
    primitive.strings = lexer.CommandWords();
    return primitive;
  }
  primitive.modifier = lexer.Word();
  primitive.type = lexer.Word();
  primitive.identifier = lexer.Word();
  if (primitive.type == "alias") {
    primitive.strings.emplace_back(lexer.Word());
    return primitive;
  }
  for (int i = CountAt(lexer); i > 0; --i) primitive.strings.emplace_back(lexer.Word());
  for (int i = CountAt(lexer); i > 0; --i) lexer.Word();  // integers, which no primitive uses
  for (int i = CountAt(lexer); i > 0; --i) {
    const std::string_view word = lexer.Word();
    const std::optional<double> value = ToNumber(word);
    if (!value || !std::isfinite(*value)) throw lexer.Error(Quoted(word) + " is no finite number");
    primitive.reals.emplace_back(word);
  }
  return primitive;
}

}  // namespace

std::vector<RadPrimitive> ReadRadText(std::string_view text, std::string_view file) {
  RadLexer lexer(text, file);
  std::vector<RadPrimitive> primitives;
  while (lexer.More()) primitives.push_back(PrimitiveAt(lexer));
  return primitives;
}

}  // namespace penumbra
