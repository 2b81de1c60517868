// display/viewer/arcball.h
//
// Shoemake's arcball (1992): the user rotates the model by dragging the surface of a ball that surrounds it.
// Positions of the mouse pointer are in pixels of the picture.

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
  // rotation about the view's right, up or forward axis, whichever is closest at the start of the drag
  kViewerAxes,
  // rotation about the x, y or z axis of the scene, whichever is closest at the start of the drag
  kSceneAxes,
};

class ArcballDrag {
 public:
  // Starts the drag of the arcball at (x, y). The centre of the ball is the picture's centre; the camera
  // rotates about camera.look_at.
  ArcballDrag(const Camera& camera, PictureSize size, double x, double y, ArcballConstraint constraint);

  // The camera when the pointer has been dragged to (x, y). A drag does not change the distance from the eye
  // to look_at or the field of view.
  Camera At(double x, double y) const;

 private:
  glm::dvec3 OnBall(double x, double y) const;

  Camera start_;
  PictureSize size_;
  glm::dmat3 axes_;  // axes of the view; the columns are the directions right, up and backward
  std::optional<glm::dvec3> constraint_;
  glm::dvec3 from_;
};

// Moves eye and look_at of the camera by the same vector, such that points at the depth of look_at move by
// (dx, dy) [pixels] in the picture.
Camera Pan(const Camera& camera, PictureSize size, double dx, double dy);
// Divides the distance from the eye to look_at by `factor`. The distance from the eye to look_at is limited
// such that the direction of view remains representable.
Camera Zoom(const Camera& camera, double factor);
// Sets the vertical field of view [degrees, clamped to kMinFov .. kMaxFov], and moves the eye such that
// objects at look_at keep their size in the picture. Warp() thus changes only the perspective of the picture.
Camera Warp(const Camera& camera, double vertical_fov);
inline constexpr double kMinFov = 2, kMaxFov = 160;

}  // namespace penumbra::viewer
