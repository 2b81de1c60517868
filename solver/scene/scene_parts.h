// solver/scene/scene_parts.h
//
// Selects the surfaces and channels whose error is measured, and divides a scene into parts whose errors are
// reported separately.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// Per patch: its area if it reflects in some channel, otherwise 0 [m^2], because irradiance is visible only
// on surfaces that reflect. If no patch of the scene reflects, the result holds the areas of all patches.
std::vector<double> ReflectingAreas(const Scene& scene);

// Per patch: the channels in which it reflects. If no patch of the scene reflects, all entries of the result
// are true.
std::vector<std::array<bool, 3>> ReflectingChannels(const Scene& scene);

struct ScenePart {
  std::string name;
  std::vector<PatchId> patches;  // sorted
};

// The parts of a scene, sorted by their first patch; each patch belongs to one part. The parts are the
// objects of the file if the file names at least two. If the file names at most one object, the parts are
// groups of faces that are connected by common vertices, and their names list the faces.
std::vector<ScenePart> PartsOf(const Scene& scene);

}  // namespace penumbra
