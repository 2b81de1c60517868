// apps/camera_arguments.h

#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

#include "solver/scene/scene.h"
#include "solver/scene/scene_frame.h"

namespace penumbra {

// The camera options of the command line.
struct CameraArguments {
  std::optional<std::string> camera;  // name or index of a camera of the scene
  std::optional<Vec3> eye, look_at, up;
  std::optional<double> vertical_fov;  // vertical angle of view in degrees
};

// Adds the camera options to the command line. The camera's option --up replaces the option --up for reading
// scenes (AddSceneArguments). If the value of --up is an axis x, y or z, `scene_up` is set to this axis.
void AddCameraOptions(CLI::App& app, CameraArguments* arguments, std::optional<UpAxis>* scene_up);

// Chooses a camera: the camera of the scene that the user requests; by default, the first camera of the
// scene, or FrameScene() if the scene has no cameras. Values from the command line replace the corresponding
// members of the camera. Throws UsageError if there is no camera with the requested name, or if the resulting
// camera is invalid (ValidateCamera).
Camera ChooseCamera(const Scene& scene, const CameraArguments& arguments);

}  // namespace penumbra
