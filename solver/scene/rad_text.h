// solver/scene/rad_text.h
//
// The primitives and commands in the text of a Radiance scene description.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

// "MODIFIER TYPE IDENTIFIER" with its arguments; or an alias, whose target is the only string; or a command,
// a line that begins with '!', whose type is "!" and whose strings are its words.
struct RadPrimitive {
  int line = 0;
  std::string modifier, type, identifier;
  std::vector<std::string> strings;
  std::vector<std::string> reals;  // as written, checked to be finite numbers
};

// All primitives of the text, in order. Comments begin with '#', anywhere. Throws InputError,
// "FILE:LINE: error: ...", if the text ends in a primitive or an argument is no number.
std::vector<RadPrimitive> ReadRadText(std::string_view text, std::string_view file);

}  // namespace penumbra
