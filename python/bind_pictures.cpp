// The functions render() and save_picture().

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "apps/camera_arguments.h"
#include "apps/option_values.h"
#include "apps/render_arguments.h"
#include "display/image_writers.h"
#include "display/passes.h"
#include "display/ray_display.h"
#include "display/reconstruction.h"
#include "display/two_pass_display.h"
#include "python/arrays.h"
#include "python/background_work.h"
#include "python/bindings.h"
#include "python/keywords.h"
#include "python/python_errors.h"
#include "python/python_solution.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

namespace py = pybind11;

using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;

// Samples of a picture: two gigabytes of buffers.
constexpr std::int64_t kMostSamples = std::int64_t{1} << 26;
constexpr int kMostSamplesPerPixel = 1024;

struct PictureRequest {
  Camera camera;
  int width = 640, height = 480;
  RenderMode mode = kRenderModes[3];
  int samples = 1;
};

RenderMode ModeOf(const std::string& name) {
  std::vector<std::string> names;
  for (const RenderMode& mode : kRenderModes) {
    if (mode.name == name) return mode;
    names.emplace_back(mode.name);
  }
  throw InputError(fmt::format("there is no mode '{}'; give one of {}", name, fmt::join(names, ", ")));
}

// None, one of the scene's cameras by name or number, or a camera.
Camera CameraOf(const Scene& scene, const py::object& value) {
  if (py::isinstance<Camera>(value)) return value.cast<Camera>();
  if (value.is_none()) return ChooseCamera(scene, {});
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const bool is_it = py::isinstance<py::str>(value)
                           ? BytesOf(value) == scene.cameras[i].name
                           : PyIndex_Check(value.ptr()) && value.equal(py::int_(i));
    if (is_it) return scene.cameras[i];
    names.push_back(fmt::format("{} ({})", i, scene.cameras[i].name));
  }
  throw InputError(fmt::format("the scene has no camera {}; it has {}", py::repr(value).cast<std::string>(),
                               names.empty() ? "none: give a Camera" : NameList(names)));
}

void CheckRequest(const PictureRequest& request) {
  const auto is_side = [](int side) { return side >= 1 && side <= kMaxPictureSize; };
  if (request.samples < 1 || request.samples > kMostSamplesPerPixel)
    throw InputError(
        fmt::format("samples={} is not an integer from 1 to {}", request.samples, kMostSamplesPerPixel));
  if (request.samples > 1 && request.mode.method == RenderMethod::kTwoPass)
    throw InputError(
        fmt::format("samples is of modes that cast rays; mode='{}' casts none", request.mode.name));
  if (!is_side(request.width) || !is_side(request.height) ||
      std::int64_t{request.width} * request.height * request.samples > kMostSamples)
    throw InputError(
        fmt::format("size=({}, {}) is not (width, height), each from 1 to {} pixels, with {} samples in all",
                    request.width, request.height, kMaxPictureSize, kMostSamples));
}

// What an EXR file of the command `render` holds.
RgbImage Draw(const PythonSolution& solution, const PictureRequest& request,
              const ExecutionContext& context) {
  const Scene& scene = *solution.scene().scene;
  if (request.mode.method == RenderMethod::kTwoPass) {
    const IrradianceMesh* mesh =
        solution.MeshOfKind(request.mode.mesh.value_or(MeshKind::kInterpolant), context);
    if (!mesh) return {};
    TwoPassDisplay display(scene, *mesh);
    return display.Render(request.camera, request.width, request.height, request.mode.shading).linear;
  }
  std::optional<ReconstructedLight> light;
  if (request.mode.method == RenderMethod::kReconstruct)
    light.emplace(ReconstructLight(request.mode.reconstruction, solution.pipeline(), context));
  RayDisplay display(scene,
                     light ? light->Shade(request.camera, request.width, request.height)
                     : request.mode.method == RenderMethod::kRayShade
                         ? RayShade(scene, solution.pipeline().irradiance())
                         : LerpShade(scene, solution.pipeline().mesh()),
                     request.samples);
  return Downsample(display.Render(request.camera, request.width, request.height, context).linear,
                    request.samples, 1);
}

py::array_t<float> Render(const PythonSolution& solution, const py::object& camera,
                          const std::pair<int, int>& size, const std::string& mode, int samples,
                          const py::object& progress) {
  const PictureRequest request = {CameraOf(*solution.scene().scene, camera), size.first, size.second,
                                  ModeOf(mode), samples};
  CheckRequest(request);
  RgbImage image;
  RunInBackground(progress, [&](const ExecutionContext& context) {
    const std::lock_guard lock(solution.Busy());
    image = Draw(solution, request, context);
  });
  py::array_t<float> array({py::ssize_t{image.height}, py::ssize_t{image.width}, py::ssize_t{3}});
  float* out = array.mutable_data();
  for (std::size_t i = 0; i < image.PixelCount(); ++i)
    for (const std::vector<float>& plane : image.channel) *out++ = plane[i];
  return array;
}

void SavePicture(const py::object& path, const FloatArray& image) {
  const std::string to = BytesOf(path);
  if (!IsLinearImage(to))
    throw InputError(fmt::format("{}: error: linear light is written to files that end in .exr", to));
  if (image.ndim() != 3 || image.shape(2) != 3 || image.size() == 0)
    throw InputError(fmt::format("image has the shape {}; give (height, width, 3)",
                                 py::str(image.attr("shape")).cast<std::string>()));
  RgbImage linear(static_cast<int>(image.shape(1)), static_cast<int>(image.shape(0)));
  for (std::size_t i = 0; i < linear.PixelCount(); ++i)
    for (std::size_t channel = 0; channel < 3; ++channel)
      linear.channel[channel][i] = image.data()[3 * i + channel];
  WriteImageFile(to, linear);
}

}  // namespace

void BindPictures(py::module_& module) {
  module.def("render", &Render, py::arg("solution"), py::arg("camera") = py::none(),
             py::arg("size") = py::make_tuple(640, 480), py::arg("mode") = "interpolant",
             py::arg("samples") = 1, py::arg("progress") = py::none(),
             R"(render(solution, camera=None, size=(640, 480), mode="interpolant", samples=1, progress=None)
    -> array of shape (height, width, 3), float32

Draws the linear radiosity in W/m^2, emittance included; 0 where nothing is seen. Rows run from the top. The values
are those of `penumbra render -o IMAGE.exr`, to the bit.

camera: a Camera; the name or number of one of the scene's; None: the first, or one that sees the whole scene.
size: (width, height) in pixels, which are square.
mode: "flat", "gouraud", "gouraud-mesh", "interpolant", "lerp" (the interpolant, by rays), "exact" (exact
    irradiance at every pixel, by rays), "rho" (the reflectance); and by rays, from the corners of the elements, "nodal",
    "gouraud-screen", "bilinear", "bicubic".
samples: rays for each pixel, of modes that cast rays.
Raises InputError for a camera, size or mode that cannot be.)");
  module.def("save_picture", &SavePicture, py::arg("path"), py::arg("image"),
             "save_picture(path, image)\n\nWrites linear light, an array of shape (height, width, 3), as "
             ".exr. Raises "
             "InputError if the file cannot be written.");
}

}  // namespace penumbra
