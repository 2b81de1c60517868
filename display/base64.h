// display/base64.h

#pragma once

#include <string>
#include <string_view>

namespace penumbra {

// The bytes in Base64 encoding (RFC 4648, section 4), padded with `=` to a multiple of four characters.
std::string Base64(std::string_view bytes);

}  // namespace penumbra
