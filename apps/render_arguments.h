// apps/render_arguments.h
//
// What `render` is told about the picture.

#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/camera_arguments.h"
#include "apps/scene_arguments.h"
#include "display/opengl_passes.h"
#include "display/two_pass_display.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// How a mode finds what a pixel shows.
enum class RenderMethod {
  kTwoPass,
  kRayShade,   // rays, exact irradiance
  kLerpShade,  // rays, interpolants
};

struct RenderMode {
  const char* name;
  RenderMethod method;
  std::optional<MeshKind> mesh;
  ShadingMode shading;
};
inline constexpr std::array<RenderMode, 7> kRenderModes = {
    {{"flat", RenderMethod::kTwoPass, MeshKind::kFlat, ShadingMode::kRadiosity},
     {"gouraud", RenderMethod::kTwoPass, MeshKind::kGouraud, ShadingMode::kRadiosity},
     {"gouraud-mesh", RenderMethod::kTwoPass, MeshKind::kGouraudMesh, ShadingMode::kRadiosity},
     {"interpolant", RenderMethod::kTwoPass, MeshKind::kInterpolant, ShadingMode::kRadiosity},
     {"exact", RenderMethod::kRayShade, std::nullopt, ShadingMode::kRadiosity},
     {"lerp", RenderMethod::kLerpShade, MeshKind::kInterpolant, ShadingMode::kRadiosity},
     {"rho", RenderMethod::kTwoPass, MeshKind::kFlat, ShadingMode::kReflectance}}};

// What draws the two passes.
enum class Backend { kSoftware, kOpenGl };

struct RenderArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::optional<std::string> output;
  RenderMode mode = kRenderModes[3];
  Backend backend = Backend::kSoftware;
  OpenGlCoordinates coordinates = OpenGlCoordinates::kFloat;
  int width = 1280, height = 960;
  std::optional<double> exposure;   // [m^2/W]; metered if not given
  bool false_colour = false;        // a PNG shows values in false colours
  std::optional<double> scale_max;  // the end of their scale [W/m^2]; what the exposure makes white if not
  bool split = false;               // a PNG shows the scratch images, too
  int benchmark_frames = 0;         // 0: no benchmark
  int supersampling = 2;            // of PNG pictures: samples a side of a pixel
  int samples = 1;                  // rays a pixel, where a mode casts rays

  bool ByRays() const { return mode.method != RenderMethod::kTwoPass; }
};

// Whether a picture has a sample a pixel, or rays.
bool HasOneSample(const RenderArguments& arguments);

void AddPictureOptions(CLI::App& app, RenderArguments* arguments);
// Those of a picture that only studies compare. REQUIRES: AddSolveOptions(), whose last group they join.
void AddPictureStudies(CLI::App& app, RenderArguments* arguments);

// What can be told before the work starts. Throws UsageError, and InputError where a file cannot be written.
void CheckRenderArguments(const RenderArguments& arguments);

// What a user could set of the picture, in the words of OptionsUsed().
nlohmann::ordered_json RenderOptionsUsed(const RenderArguments& arguments);

}  // namespace penumbra
