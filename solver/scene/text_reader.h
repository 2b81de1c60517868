// solver/scene/text_reader.h
//
// Common functions of the readers of line-based scene files: logical lines, words, numbers, and error
// messages with line numbers.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/base/check.h"

namespace penumbra {

// An error "FILE:LINE: error: MESSAGE". LINE is omitted if `line` is 0, which means the whole file.
InputError ErrorAt(std::string_view file, int line, std::string_view message);

// The text "FILE:LINE: warning: MESSAGE". LINE is omitted if `line` is 0.
std::string WarningAt(std::string_view file, int line, std::string_view message);

// The text "FILE:LINE", printable in a message.
std::string PlaceOf(std::string_view file, int line);

// The text as one printable line. Control characters and bytes that are not valid UTF-8 are escaped, as in \n
// and \x1b. A text of more than `longest` bytes is truncated and ends in "...".
std::string Printable(std::string_view text, std::size_t longest);

// The result of Printable() in quotation marks, truncated to a length suitable for messages.
std::string Quoted(std::string_view text);

// The first of the names, quoted, and the number of further names.
std::string QuotedList(const std::vector<std::string>& names);

// Throws InputError if the beginning of the text shows that it has another format. `wanted` is the expected
// format, such as "an OBJ file".
void RefuseForeignFormat(std::string_view text, std::string_view file, std::string_view wanted);

// The text of a warning: the lines of a file end in a carriage return (CR) without a line feed. Such files
// are accepted.
inline constexpr std::string_view kLinesEndInCr =
    "lines end in CR alone, as in files of old Macintoshes, and are read so";

// The binary64 number nearest to the number `word`; nullopt if `word` is not a number. Numbers too small for
// binary64 give 0, too large ones infinity. The words for infinity and NaN give infinity and NaN.
std::optional<double> ToNumber(std::string_view word);

// Splits a text into lines, which end in LF, CR LF or CR. A UTF-8 byte order mark at the beginning is
// skipped.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  bool AtEnd() const { return rest_.empty(); }
  // The next line, without its line end.
  std::string_view Take();
  // The 1-based number of the line that the next Take() returns.
  int NextLine() const { return next_line_; }
  // The number of the first line that ends in CR alone among the lines taken so far; 0 if there is none.
  int LineEndedByCr() const { return cr_line_; }

 private:
  std::string_view rest_;
  std::size_t line_feed_ = 0;  // position of the next LF in `rest_`; the size of `rest_` if there is none
  int next_line_ = 1, cr_line_ = 0;
};

// Splits a text into statements. A line that ends in a backslash is joined with the next one. Lines that
// begin with # and blank lines are skipped. Surrounding blanks are removed.
class StatementReader {
 public:
  StatementReader(std::string_view text, std::string_view file) : lines_(text), file_(file) {}

  // Advances to the next statement; false at the end of the text.
  bool Next();

  std::string_view Keyword() const { return keyword_; }
  std::string_view Arguments() const { return arguments_; }  // what follows the keyword, trimmed
  std::vector<std::string_view> Words() const;               // the arguments, split at blanks
  // The words up to the first word that begins with #, which starts a comment. Use the function only for
  // statements without names, because a name may contain #.
  std::vector<std::string_view> Values() const;
  int Line() const { return line_; }  // the 1-based number of the statement's first line
  const std::string& File() const { return file_; }
  int LineEndedByCr() const { return lines_.LineEndedByCr(); }

  // An error that refers to this statement, for the caller to throw.
  InputError Error(std::string_view message) const { return ErrorAt(file_, line_, message); }

  // The binary64 number nearest to the number `word`. Throws InputError unless `word` is a finite number.
  double Number(std::string_view word) const;

 private:
  bool TakeStatement();

  LineReader lines_;
  std::string file_;
  std::string joined_;  // a statement of several lines
  std::string_view keyword_, arguments_;
  int line_ = 0;
};

}  // namespace penumbra
