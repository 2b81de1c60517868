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

// --up, which says two things, told apart by what is given, and may be given for each: an axis of the file,
// as for all scenes, and the direction that is up in the picture.
void AddUp(CLI::App& app, CameraArguments* arguments, std::optional<UpAxis>* scene_up,
           const std::string& group) {
  if (CLI::Option* const of_scene = app.get_option_no_throw("--up")) app.remove_option(of_scene);
  const auto read = [=](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      if (const std::optional<UpAxis> axis = UpAxisNamed(text)) {
        *scene_up = axis;
        continue;
      }
      const std::optional<Vec3> direction = ParseVector(text);
      if (!direction || !kDirection.holds(*direction))
        throw CLI::ValidationError("--up",
                                   fmt::format("'{}' is neither x, y or z nor {}", text, kDirection.words));
      arguments->up = *direction;
    }
  };
  app.add_option_function<std::vector<std::string>>(
         "--up", read,
         "x,y,z: the direction that is up in the picture (default: the camera's, else z). Or x, y or z: the "
         "axis of the scene file that points up (default: what the file or its format says, else z)")
      ->type_name("x,y,z|AXIS")
      ->expected(1)
      ->take_all()
      ->group(group);
}

}  // namespace

void AddCameraOptions(CLI::App& app, CameraArguments* arguments, std::optional<UpAxis>* scene_up) {
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
  AddUp(app, arguments, scene_up, group);
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
