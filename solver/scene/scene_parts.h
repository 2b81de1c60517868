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
// on surfaces that reflect. If nothing in the scene reflects, all areas.
std::vector<double> ReflectingAreas(const Scene& scene);

// Per patch: the channels in which it reflects. If nothing in the scene reflects, all channels.
std::vector<std::array<bool, 3>> ReflectingChannels(const Scene& scene);

struct ScenePart {
  std::string name;
  std::vector<PatchId> patches;  // sorted
};

// The parts of a scene, sorted by their first patch; each patch belongs to one part. Parts are the objects of
// the file. If the file names at most one object, parts are groups of faces that are connected by common
// vertices, and their names list the faces.
std::vector<ScenePart> PartsOf(const Scene& scene);

}  // namespace penumbra
