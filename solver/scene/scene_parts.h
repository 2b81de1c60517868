// solver/scene/scene_parts.h
//
// Selects the surfaces and colour channels whose error is measured, and divides a scene into parts whose
// errors are reported separately.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// For each patch, its area if the patch reflects in some colour channel, otherwise 0 [m^2], because
// irradiance is visible only on surfaces that reflect. If no patch of the scene reflects, the result holds
// the areas of all patches.
std::vector<double> ReflectingAreas(const Scene& scene);

// For each patch, the colour channels in which the patch reflects. If no patch of the scene reflects, all
// channels of all patches are returned as reflecting.
std::vector<std::array<bool, 3>> ReflectingChannels(const Scene& scene);

struct ScenePart {
  std::string name;
  std::vector<PatchId> patches;  // the indices of the patches of the scene's part, in ascending order
};

// Divides a scene into parts, sorted by their first patch; each patch belongs to one part. If the file names
// at least two objects, the objects are the parts. If the file names at most one object, the parts are groups
// of faces that are connected by common vertices, and the names of the parts list the faces.
std::vector<ScenePart> PartsOf(const Scene& scene);

}  // namespace penumbra
