// apps/named_faces.h

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The numbers of the faces of all objects and groups called `name`, sorted and without repetition. If no
// object or group is called `name`, `name` must be the number of a face, and the result is this face. If
// `name` names neither an object, a group nor a face, throws InputError; the message begins with `scene_name`
// and lists the existing names.
std::vector<std::int32_t> FacesNamed(const Scene& scene, const std::string& scene_name,
                                     const std::string& name);

}  // namespace penumbra
