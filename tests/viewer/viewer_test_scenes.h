// tests/viewer/viewer_test_scenes.h

#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "display/viewer/viewer.h"
#include "tests/mesh/mesh_test_scenes.h"

namespace penumbra::viewer_test {

// Makes a scene with a floor under a lamp, and a smaller square between them that throws a shadow on the
// floor. Only the fronts of the floor and of the square reflect light.
inline std::shared_ptr<const Scene> ShadowScene() {
  Scene scene = mesh_test::EmptyScene();
  scene.name = "shadow";
  mesh_test::AddSquare(scene, {0, 0, 0}, 1, true);             // patch 0: floor
  mesh_test::AddSquare(scene, {0, 0, 2}, 0.5, false, 1);       // patch 1: lamp
  mesh_test::AddSquare(scene, {0.1, 0.05, 1}, 0.3, false, 0);  // patch 2: blocker
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    const auto vertices = scene.patches[i].Vertices();
    scene.faces.push_back({{vertices.begin(), vertices.end()}, scene.patches[i].material, 0});
  }
  scene.cameras.push_back({"above", Vec3(0.3, -2.6, 1.6), Vec3(0, 0, 0.4), Vec3::UnitZ(), 45});
  scene.cameras.push_back({"straight down", Vec3(0.02, 0.01, 0.9), Vec3(0, 0, 0), Vec3::UnitY(), 90});
  return std::make_shared<const Scene>(std::move(scene));
}

inline viewer::ViewerOptions Options(bool solve) {
  viewer::ViewerOptions options;
  options.scene_name = "shadow";
  options.solve = solve;
  options.solving.error = 0.1;
  options.solving.error_points = 50;
  return options;
}

// Draws frames until the viewer computes nothing any more. Settle() returns false if the viewer computes for
// more than half a minute.
inline bool Settle(viewer::Viewer& viewer, int width = 96, int height = 64) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < end) {
    viewer.Frame(width, height, 0.02);
    if (viewer.Idle()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

inline viewer::InputEvent Button(viewer::InputEvent::Kind kind, viewer::MouseButton button, double x,
                                 double y, unsigned modifiers = 0) {
  viewer::InputEvent event;
  event.kind = kind;
  event.button = button;
  event.x = x;
  event.y = y;
  event.modifiers = modifiers;
  return event;
}

inline void Click(viewer::Viewer& viewer, viewer::MouseButton button, double x, double y,
                  unsigned modifiers = 0) {
  viewer.Handle(Button(viewer::InputEvent::Kind::kButtonDown, button, x, y, modifiers));
  viewer.Handle(Button(viewer::InputEvent::Kind::kButtonUp, button, x, y, modifiers));
}

inline void Drag(viewer::Viewer& viewer, viewer::MouseButton button, double x0, double y0, double x1,
                 double y1) {
  viewer.Handle(Button(viewer::InputEvent::Kind::kButtonDown, button, x0, y0, 0));
  viewer.Handle(Button(viewer::InputEvent::Kind::kMove, button, x1, y1, 0));
  viewer.Handle(Button(viewer::InputEvent::Kind::kButtonUp, button, x1, y1, 0));
}

// Returns the place on the screen where the camera shows a point.
inline viewer::ScreenPoint PlaceOf(const viewer::Viewer& viewer, const Vec3& point, int width = 96,
                                   int height = 64) {
  return viewer::Project(MakePixelRays(viewer.view().camera, width, height), point);
}

}  // namespace penumbra::viewer_test
