// display/glb_file.h

#pragma once

#include <string>

namespace penumbra {

// A binary glTF 2.0 file of a JSON text and, unless it is empty, one buffer.
std::string GlbFile(const std::string& json, const std::string& buffer);

}  // namespace penumbra
