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

// "FILE:LINE: error: MESSAGE"; without LINE where that is 0: the whole file is meant.
InputError ErrorAt(std::string_view file, int line, std::string_view message);

// "FILE:LINE: warning: MESSAGE", or without LINE.
std::string WarningAt(std::string_view file, int line, std::string_view message);

// "FILE:LINE", fit for a message.
std::string PlaceOf(std::string_view file, int line);

// The text as one line that a terminal shows as it is: control characters and what is no UTF-8 are written
// like \n and \x1b; what is longer than `longest` bytes ends in "...".
std::string Printable(std::string_view text, std::size_t longest);

// The same in quotation marks, of a length that suits a message.
std::string Quoted(std::string_view text);

// The first of the names, quoted, and how many more there are.
std::string QuotedList(const std::vector<std::string>& names);

// Throws InputError if the text is that of another format, told by its beginning. `wanted`: "an OBJ file".
void RefuseForeignFormat(std::string_view text, std::string_view file, std::string_view wanted);

// What is said of a text with such line ends, which are read as any.
inline constexpr std::string_view kLinesEndInCr =
    "lines end in CR alone, as in files of old Macintoshes, and are read so";

// The binary64 number nearest to the word, 0 for one that is closer to it than any; nothing if the word is no
// number. One that is not finite, or beyond all finite ones, gives infinity or NaN.
std::optional<double> ToNumber(std::string_view word);

// Cuts a text into lines, which end in LF, CR LF or CR; a mark of UTF-8 at its beginning is left out.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  bool AtEnd() const { return rest_.empty(); }
  // The next line, without its end.
  std::string_view Take();
  // The 1-based number of the line that Take() gives next.
  int NextLine() const { return next_line_; }
  // The first line so far that ends in a CR alone; 0 if there is none.
  int LineEndedByCr() const { return cr_line_; }

 private:
  std::string_view rest_;
  std::size_t line_feed_ = 0;  // in `rest_`, where the next one is; its size if there is none
  int next_line_ = 1, cr_line_ = 0;
};

// Cuts a text into statements: lines, joined where they end in a backslash, without those that a # begins and
// without surrounding blanks; blank ones are left out.
class StatementReader {
 public:
  StatementReader(std::string_view text, std::string_view file) : lines_(text), file_(file) {}

  // Moves to the next statement; false at the end of the text.
  bool Next();

  std::string_view Keyword() const { return keyword_; }
  std::string_view Arguments() const { return arguments_; }  // what follows the keyword, trimmed
  std::vector<std::string_view> Words() const;               // the arguments, split at blanks
  // The words of a statement that holds no names: those before one that # begins, which is a remark there.
  std::vector<std::string_view> Values() const;
  int Line() const { return line_; }  // the 1-based line that the statement begins in
  const std::string& File() const { return file_; }
  int LineEndedByCr() const { return lines_.LineEndedByCr(); }

  // The error for this statement, to be thrown.
  InputError Error(std::string_view message) const { return ErrorAt(file_, line_, message); }

  // The binary64 number nearest to the word. Throws InputError unless it is a finite number.
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
