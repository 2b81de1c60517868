// solver/scene/embedded_scenes.h

#pragma once

#include <span>
#include <string_view>

namespace penumbra {

struct EmbeddedFile {
  std::string_view name, text;
};

// The files of the folder scenes/, sorted by name. The build generates the definition of this function.
std::span<const EmbeddedFile> EmbeddedSceneFiles();

}  // namespace penumbra
