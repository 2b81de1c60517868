// display/markup.h

#pragma once

#include <string>
#include <string_view>

namespace penumbra {

// The text as characters of HTML or XML: the characters &, <, > and " become entities, and control characters
// are left out.
std::string EscapeMarkup(std::string_view text);

}  // namespace penumbra
