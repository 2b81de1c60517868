// display/glb_file.h

#pragma once

#include <string>

namespace penumbra {

// The bytes of a binary glTF 2.0 file with the given JSON text and, unless `buffer` is empty, one binary
// buffer.
std::string GlbFile(const std::string& json, const std::string& buffer);

}  // namespace penumbra
