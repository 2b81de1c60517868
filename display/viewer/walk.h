// display/viewer/walk.h
//
// Walking and flying through a scene.

#pragma once

#include <glm/vec3.hpp>

#include "solver/scene/scene.h"

namespace penumbra::viewer {

// The camera moved [m] along its view, to its right and along `up`, a unit vector.
Camera Fly(const Camera& camera, double forward, double right, double upward, const glm::dvec3& up);

// The view turned by these angles [radians], to the right about `up`, a unit vector, and upwards; it stops
// short of looking along `up`. The camera stands upright afterwards.
Camera Look(const Camera& camera, double right, double upward, const glm::dvec3& up);

}  // namespace penumbra::viewer
