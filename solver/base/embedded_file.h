// solver/base/embedded_file.h
//
// An EmbeddedFile is a text file that is compiled into the program. The build script cmake/EmbedFiles.cmake
// converts each of these files to source code.

#pragma once

#include <span>
#include <string_view>

namespace penumbra {

struct EmbeddedFile {
  std::string_view name, text;
};

}  // namespace penumbra
