#include "apps/camera_arguments.h"

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/option_values.h"
#include "display/camera.h"

namespace penumbra {
namespace {

constexpr NumberRule kFieldOfView{[](double x) { return x >= 1e-3 && x <= 179; },
                                  "an angle from 0.001 to 179 degrees"};

Camera FindCamera(const Scene& scene, const std::string& name) {
  for (const Camera& camera : scene.cameras)
    if (camera.name == name) return camera;
  const std::optional<double> index = ParseNumber(name);
  for (std::size_t i = 0; index && i < scene.cameras.size(); ++i)
    if (*index == static_cast<double>(i)) return scene.cameras[i];
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    names.push_back(fmt::format("{} ({})", i, scene.cameras[i].name));
  throw UsageError(fmt::format("the scene has no camera '{}'; it has {}", name,
                               names.empty() ? "none: place one with --eye and --look-at" : NameList(names)));
}

}  // namespace

void AddCameraOptions(CLI::App& app, CameraArguments* arguments) {
  const std::string group = "Camera";
  app.add_option("--camera", arguments->camera,
                 "One of the scene's cameras (default: the first; a scene without one is framed, z up)")
      ->type_name("NAME|INDEX")
      ->group(group);
  AddVector(app, "--eye", &arguments->eye, kPoint, "Where the camera stands [m] (default: the camera's)")
      ->group(group);
  AddVector(app, "--look-at", &arguments->look_at, kPoint,
            "A point in the middle of the picture [m] (default: the camera's)")
      ->group(group);
  AddVector(app, "--up", &arguments->up, kDirection,
            "The direction that is up in the picture (default: the camera's, else z)")
      ->group(group);
  AddNumber(app, "--fov", &arguments->vertical_fov, kFieldOfView,
            "Vertical field of view [degrees] (default: the camera's, else 45)")
      ->group(group);
}

Camera ChooseCamera(const Scene& scene, const CameraArguments& arguments) {
  Camera camera = arguments.camera         ? FindCamera(scene, *arguments.camera)
                  : !scene.cameras.empty() ? scene.cameras.front()
                                           : FrameScene(scene);
  if (arguments.eye) camera.eye = *arguments.eye;
  if (arguments.look_at) camera.look_at = *arguments.look_at;
  if (arguments.up) camera.up = *arguments.up;
  if (arguments.vertical_fov) camera.vertical_fov = *arguments.vertical_fov;
  if (camera.eye == camera.look_at)
    throw UsageError("--eye and --look-at are the same point; move one of them");
  if (arguments.up && !CanBeUp(*arguments.up, camera))
    throw UsageError("--up is parallel to the view from --eye to --look-at; give another direction");
  return camera;
}

}  // namespace penumbra
