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

// An InputError with the text "FILE:LINE: error: MESSAGE", or "FILE: error: MESSAGE" if `line` is 0, which
// means the whole file.
InputError ErrorAt(std::string_view file, int line, std::string_view message);

// The text "FILE:LINE: warning: MESSAGE", or "FILE: warning: MESSAGE" if `line` is 0, which means the whole
// file.
std::string WarningAt(std::string_view file, int line, std::string_view message);

// The text "FILE:LINE", printable in a message.
std::string PlaceOf(std::string_view file, int line);

// Returns the text as one printable line. Control characters and bytes that are not valid UTF-8 are escaped,
// as in \n and \x1b. A text of more than `longest` bytes is truncated and ends in "...".
std::string Printable(std::string_view text, std::size_t longest);

// The result of Printable() in quotation marks, truncated to a length suitable for messages.
std::string Quoted(std::string_view text);

// Returns a short text for a list of names: the first few names in quotation marks, and the number of the
// others.
std::string QuotedList(const std::vector<std::string>& names);

// Throws InputError if the beginning of the text shows a format other than the expected format. `wanted` is
// the expected format, such as "an OBJ file".
void RefuseForeignFormat(std::string_view text, std::string_view file, std::string_view wanted);

// The text of the warning that the lines of a file end in a carriage return (CR) without a line feed; such
// files are accepted.
inline constexpr std::string_view kLinesEndInCr =
    "lines end in CR alone, as in files of old Macintoshes, and are read so";

// Converts `word` to the nearest binary64 number; nullopt if `word` is not a number. Numbers too small for
// binary64 become 0, and numbers too large become infinity. Words for infinity and NaN count as numbers.
std::optional<double> ToNumber(std::string_view word);

// Splits a text into lines, which end in LF, CR LF or CR. A UTF-8 byte order mark at the beginning is
// skipped.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  bool AtEnd() const { return rest_.empty(); }
  // Returns the next line, without the characters that end the line.
  std::string_view Take();
  // The number, counted from 1, of the line that the next call of Take() returns.
  int NextLine() const { return next_line_; }
  // The number of the first line that ends in CR without LF, among the lines taken so far; 0 if there is no
  // such line.
  int LineEndedByCr() const { return cr_line_; }

 private:
  std::string_view rest_;
  // The position of the next line feed in `rest_`; the size of `rest_` if there is none.
  std::size_t line_feed_ = 0;
  int next_line_ = 1, cr_line_ = 0;
};

// Splits a text into statements, one for each line. A line that ends in a backslash is joined with the next
// line. Lines that begin with # and blank lines are skipped. Blanks around a statement are removed.
class StatementReader {
 public:
  StatementReader(std::string_view text, std::string_view file) : lines_(text), file_(file) {}

  // Advances to the next statement of the text; returns false at the end of the text.
  bool Next();

  std::string_view Keyword() const { return keyword_; }
  // The text of the statement behind the keyword, without surrounding blanks.
  std::string_view Arguments() const { return arguments_; }
  std::vector<std::string_view> Words() const;  // the arguments of the current statement, split at blanks
  // The arguments up to the first word that begins with #, which starts a comment. Use Values() only for
  // statements without names, because a name may contain #.
  std::vector<std::string_view> Values() const;
  int Line() const { return line_; }  // line number, from 1, of the statement's first line
  const std::string& File() const { return file_; }
  int LineEndedByCr() const { return lines_.LineEndedByCr(); }

  // Returns an InputError that refers to the current statement, for the caller to throw.
  InputError Error(std::string_view message) const { return ErrorAt(file_, line_, message); }

  // Converts `word` to the nearest binary64 number. Throws InputError unless `word` is a finite number.
  double Number(std::string_view word) const;

 private:
  bool TakeStatement();

  LineReader lines_;
  std::string file_;
  std::string joined_;  // the text of a statement that extends over several lines of the file
  std::string_view keyword_, arguments_;
  int line_ = 0;
};

}  // namespace penumbra
