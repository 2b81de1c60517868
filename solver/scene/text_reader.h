// solver/scene/text_reader.h
//
// What the readers of line-based scene files share: logical lines, words, numbers, and errors that name the
// line.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/base/check.h"

namespace penumbra {

// "FILE:LINE: error: MESSAGE".
InputError ErrorAt(std::string_view file, int line, std::string_view message);

// "FILE:LINE: warning: MESSAGE".
std::string WarningAt(std::string_view file, int line, std::string_view message);

// The text in quotation marks, fit for a message of one line: shortened, without control characters.
std::string Quoted(std::string_view text);

// The binary64 number nearest to the word, 0 for one that is closer to it than any; nothing if the word is no
// number. One that is not finite, or beyond all finite ones, gives infinity or NaN.
std::optional<double> ToNumber(std::string_view word);

// Cuts a text into statements: lines, joined where they end in a backslash, without comments (from a # that
// no word holds to the end of the line) and surrounding blanks; blank ones are left out. Line ends are LF or
// CR LF.
class StatementReader {
 public:
  StatementReader(std::string_view text, std::string_view file) : rest_(text), file_(file) {}

  // Moves to the next statement; false at the end of the text.
  bool Next();

  std::string_view Keyword() const { return keyword_; }
  std::string_view Arguments() const { return arguments_; }  // what follows the keyword, trimmed
  std::vector<std::string_view> Words() const;               // the arguments, split at blanks
  int Line() const { return line_; }                         // the 1-based line that the statement begins in
  const std::string& File() const { return file_; }

  // The error for this statement, to be thrown.
  InputError Error(std::string_view message) const { return ErrorAt(file_, line_, message); }

  // The binary64 number nearest to the word. Throws InputError unless it is a finite number.
  double Number(std::string_view word) const;

 private:
  std::string_view TakeLine();

  std::string_view rest_;
  std::string file_;
  std::string statement_;
  std::string_view keyword_, arguments_;
  int line_ = 0, next_line_ = 1;
};

}  // namespace penumbra
