// display/walkthrough/embedded_page.h

#pragma once

#include "solver/base/embedded_file.h"

namespace penumbra {

// The files of the page that shows a mesh in a browser, sorted by name. The build generates the definition of
// this function.
std::span<const EmbeddedFile> EmbeddedPageFiles();

}  // namespace penumbra
