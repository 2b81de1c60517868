// display/walkthrough/embedded_page.h

#pragma once

#include "solver/base/embedded_file.h"

namespace penumbra {

// The files of the HTML page that shows a mesh in a browser, sorted by name. The build generates the
// definition of EmbeddedPageFiles().
std::span<const EmbeddedFile> EmbeddedPageFiles();

}  // namespace penumbra
