// solver/base/embedded_file.h
//
// Text files that are compiled into the program. The build script cmake/EmbedFiles.cmake converts each file
// to source code.

#pragma once

#include <span>
#include <string_view>

namespace penumbra {

struct EmbeddedFile {
  std::string_view name, text;
};

}  // namespace penumbra
