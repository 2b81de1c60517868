// display/viewer/walk.h
//
// Camera movements for walking and flying through a scene.

#pragma once

#include <glm/vec3.hpp>

#include "solver/scene/scene.h"

namespace penumbra::viewer {

// Moves the camera [m] by `forward` along its view, by `right` to its right, and by `upward` along the unit
// vector `up`.
Camera Fly(const Camera& camera, double forward, double right, double upward, const glm::dvec3& up);

// Turns the camera's view [radians] by `right` to the right about the unit vector `up`, and by `upward`
// upwards. The angle of elevation of the view remains between -90 and 90 degrees. The turned camera is
// upright.
Camera Look(const Camera& camera, double right, double upward, const glm::dvec3& up);

}  // namespace penumbra::viewer
