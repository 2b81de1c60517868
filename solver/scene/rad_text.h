// solver/scene/rad_text.h
//
// Splits the text of a Radiance scene description into primitives and commands.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

// A Radiance primitive "MODIFIER TYPE IDENTIFIER" with its arguments. For an alias, the only string is the
// name of the target. For a command, which is a line that begins with '!', the type is "!" and the strings
// are the words of the line.
struct RadPrimitive {
  int line = 0;
  std::string modifier, type, identifier;
  std::vector<std::string> strings;
  // The real arguments of a Radiance primitive, as written in the file; all are finite.
  std::vector<std::string> reals;
};

// Returns all primitives and commands of the text, in the order of the text. Comments begin with '#' at any
// position in a line. Throws InputError, "FILE:LINE: error: ...", if the text ends within a primitive or if
// an argument is no number.
std::vector<RadPrimitive> ReadRadText(std::string_view text, std::string_view file);

}  // namespace penumbra
