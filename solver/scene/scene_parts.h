// solver/scene/scene_parts.h
//
// What of a scene counts where errors are measured: what can be seen, and part by part.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The irradiance of a surface is seen where it reflects. The areas of the patches that reflect in some
// channel, and 0 for the others [m^2], by patch; all areas where nothing in the scene reflects.
std::vector<double> SeenAreas(const Scene& scene);

// The channels in which each patch reflects; all of them where nothing in the scene reflects.
std::vector<std::array<bool, 3>> SeenChannels(const Scene& scene);

struct ScenePart {
  std::string name;
  std::vector<PatchId> patches;  // ascending
};

// The parts of a scene, each patch in one: the objects of the file; where it names at most one, groups of
// faces that hang together by common vertices, named by their faces. Parts ascend by their first patch.
std::vector<ScenePart> PartsOf(const Scene& scene);

}  // namespace penumbra
