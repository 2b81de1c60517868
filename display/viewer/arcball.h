// display/viewer/arcball.h
//
// Shoemake's arcball (1992): the user rotates the model by dragging the surface of a ball that surrounds it.
// Positions of the pointer are in pixels of the picture.

#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "solver/scene/scene.h"

namespace penumbra::viewer {

struct PictureSize {
  int width = 1, height = 1;
};

enum class ArcballConstraint {
  kNone,
  kViewerAxes,  // rotation about right, up or forward, whichever is closest at the start of the drag
  kSceneAxes,   // the same for x, y and z
};

class ArcballDrag {
 public:
  // Starts the drag at (x, y). The ball has its centre in the picture's centre; the rotation is about
  // camera.look_at.
  ArcballDrag(const Camera& camera, PictureSize size, double x, double y, ArcballConstraint constraint);

  // The camera when the pointer has been dragged to (x, y). The distance to look_at and the field of view do
  // not change.
  Camera At(double x, double y) const;

 private:
  glm::dvec3 OnBall(double x, double y) const;

  Camera start_;
  PictureSize size_;
  glm::dmat3 axes_;  // columns: right, up, backward
  std::optional<glm::dvec3> constraint_;
  glm::dvec3 from_;
};

// Moves eye and look_at of the camera by the same vector, such that points at the depth of look_at move by
// (dx, dy) [pixels] in the picture.
Camera Pan(const Camera& camera, PictureSize size, double dx, double dy);
// Divides the distance to look_at by `factor`, limited such that the direction of view remains representable.
Camera Zoom(const Camera& camera, double factor);
// Sets the field of view [degrees, clamped to kMinFov .. kMaxFov], and the distance such that objects at
// look_at keep their size. Warp() thus changes only the perspective of the picture.
Camera Warp(const Camera& camera, double vertical_fov);
inline constexpr double kMinFov = 2, kMaxFov = 160;

}  // namespace penumbra::viewer
