// apps/named_faces.h

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The faces of the objects and groups called `name`; if there are none, the face whose number `name` is.
// Sorted, each once. Throws InputError, which begins with `scene_name` and lists what there is, if nothing is
// called so.
std::vector<std::int32_t> FacesNamed(const Scene& scene, const std::string& scene_name,
                                     const std::string& name);

}  // namespace penumbra
