// apps/camera_arguments.h

#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

#include "solver/scene/scene.h"

namespace penumbra {

// Where the command line puts the camera.
struct CameraArguments {
  std::optional<std::string> camera;  // the name or the index of one of the scene's
  std::optional<Vec3> eye, look_at, up;
  std::optional<double> vertical_fov;  // degrees
};

void AddCameraOptions(CLI::App& app, CameraArguments* arguments);

// The scene's camera that was asked for, else its first, else one that frames the scene, with what the
// command line says instead of its own. Throws UsageError if there is none of that name or it cannot see.
Camera ChooseCamera(const Scene& scene, const CameraArguments& arguments);

}  // namespace penumbra
