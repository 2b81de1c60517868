// display/viewer/arcball.h
//
// Shoemake's arcball (1992): the model turns as if a ball around it were dragged. Positions are pixels of the
// picture.

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
  kViewerAxes,  // rotation about right, up or forward, whichever is nearest where the drag begins
  kSceneAxes,   // the same of x, y and z
};

class ArcballDrag {
 public:
  // The drag begins at (x, y). The ball is centred in the picture and turns about camera.look_at.
  ArcballDrag(const Camera& camera, PictureSize size, double x, double y, ArcballConstraint constraint);

  // The camera with the pointer at (x, y). Distance and field of view stay.
  Camera At(double x, double y) const;

 private:
  glm::dvec3 OnBall(double x, double y) const;

  Camera start_;
  PictureSize size_;
  glm::dmat3 axes_;  // columns: right, up, backward
  std::optional<glm::dvec3> constraint_;
  glm::dvec3 from_;
};

// The camera and what it looks at, moved with what lies at look_at's depth under the pointer, which went
// (dx, dy) [pixels].
Camera Pan(const Camera& camera, PictureSize size, double dx, double dy);
// The distance to look_at divided by `factor`, as near and as far as numbers keep the direction.
Camera Zoom(const Camera& camera, double factor);
// Another field of view [degrees, clamped to kMinFov .. kMaxFov] and distance, so that what lies at look_at
// keeps its size: the perspective alone changes.
Camera Warp(const Camera& camera, double vertical_fov);
inline constexpr double kMinFov = 2, kMaxFov = 160;

}  // namespace penumbra::viewer
