// python/scene_keywords.h

#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "apps/scene_arguments.h"
#include "python/keywords.h"

namespace penumbra {

// The keyword arguments for all scenes: `two_sided`, `flip`, `strict`, `max_reflectance`.
std::vector<Keyword> FaceKeywords(SceneOptions* reading);

// The keyword arguments for scene files: those of FaceKeywords(), `emission_is_radiance`, and the
// dictionaries `emittance` and `reflectance`, whose keys are names of materials.
std::vector<Keyword> FileKeywords(SceneArguments* arguments);

}  // namespace penumbra
