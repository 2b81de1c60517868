// apps/face_list.h
//
// Lists the faces of a scene for `penumbra info --faces`.

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "solver/scene/scene.h"

namespace penumbra {

// The faces in the order of their numbers, one paragraph each: object, material, area [m^2], centroid [m],
// unit normal, reflectance, emittance [W/m^2], and one line for each corner [m]. A face that was dropped has
// no corners, and its area is 0.
std::string FaceListText(const Scene& scene);

// The faces in the order of their numbers, as a JSON array of objects. `with_corners` adds the centroid and
// the corners of each face. The area of a face that was dropped is 0.
nlohmann::ordered_json FaceListJson(const Scene& scene, bool with_corners);

}  // namespace penumbra
