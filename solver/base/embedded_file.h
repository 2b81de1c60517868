// solver/base/embedded_file.h
//
// Files that travel inside the program. The build makes their texts into code: cmake/EmbedFiles.cmake.

#pragma once

#include <span>
#include <string_view>

namespace penumbra {

struct EmbeddedFile {
  std::string_view name, text;
};

}  // namespace penumbra
