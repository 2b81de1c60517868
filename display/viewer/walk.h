// display/viewer/walk.h
//
// Camera movements for walking and flying through a scene.

#pragma once

#include <glm/vec3.hpp>

#include "solver/scene/scene.h"

namespace penumbra::viewer {

// Moves the camera by these distances [m]: along its view, to its right, and along `up`, a unit vector.
Camera Fly(const Camera& camera, double forward, double right, double upward, const glm::dvec3& up);

// Turns the view by these angles [radians]: to the right about `up`, a unit vector, and upwards. The angle of
// elevation remains between -90 and 90 degrees. In the result, the camera is upright.
Camera Look(const Camera& camera, double right, double upward, const glm::dvec3& up);

}  // namespace penumbra::viewer
