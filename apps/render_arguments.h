// apps/render_arguments.h
//
// The arguments of the command `render` that concern the picture.

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

// The methods by which the colour of a pixel is computed.
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
  const char* help;
};
inline constexpr std::array<RenderMode, 7> kRenderModes = {
    {{"flat", RenderMethod::kTwoPass, MeshKind::kFlat, ShadingMode::kRadiosity, "one value an element"},
     {"gouraud", RenderMethod::kTwoPass, MeshKind::kGouraud, ShadingMode::kRadiosity,
      "exact irradiance at the elements' corners, linear between"},
     {"gouraud-mesh", RenderMethod::kTwoPass, MeshKind::kGouraudMesh, ShadingMode::kRadiosity,
      "the same on the discontinuity mesh"},
     {"interpolant", RenderMethod::kTwoPass, MeshKind::kInterpolant, ShadingMode::kRadiosity,
      "quadratic on that mesh, the two-pass display"},
     {"exact", RenderMethod::kRayShade, std::nullopt, ShadingMode::kRadiosity,
      "exact irradiance at every pixel, by rays (RayShade)"},
     {"lerp", RenderMethod::kLerpShade, MeshKind::kInterpolant, ShadingMode::kRadiosity,
      "the interpolant, found by rays (LerpShade)"},
     {"rho", RenderMethod::kTwoPass, MeshKind::kFlat, ShadingMode::kReflectance, "reflectance alone"}}};

// The back ends that draw the two passes.
enum class Backend { kSoftware, kOpenGl };

struct RenderArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::optional<std::string> output;
  RenderMode mode = kRenderModes[3];
  Backend backend = Backend::kSoftware;
  OpenGlCoordinates coordinates = OpenGlCoordinates::kFloat;
  int width = 1280, height = 960;
  std::optional<double> exposure;   // [m^2/W]; metered without a value
  bool false_colour = false;        // a PNG shows false colours
  std::optional<double> scale_max;  // end of the scale [W/m^2]; default: what the exposure makes white
  bool split = false;               // a PNG also shows the scratch images
  int benchmark_frames = 0;         // 0: no benchmark
  int supersampling = 2;            // of PNG pictures: samples per side of a pixel
  int samples = 1;                  // rays per pixel, in modes that cast rays

  bool ByRays() const { return mode.method != RenderMethod::kTwoPass; }
};

// True if the picture is not supersampled: it has one sample per pixel, or it is made by ray casting.
bool HasOneSample(const RenderArguments& arguments);

void AddPictureOptions(CLI::App& app, RenderArguments* arguments);
// Adds those options of the picture that serve only to compare methods, to the group OptionGroup::kStudies of
// the help. REQUIRES: AddSolveOptions() was called.
void AddPictureStudies(CLI::App& app, RenderArguments* arguments);

// Checks everything that can be checked before the work starts. Throws UsageError if arguments contradict
// each other. Throws InputError if an output file cannot be written.
void CheckRenderArguments(const RenderArguments& arguments);

// The options of the picture, in the format of OptionsUsed().
nlohmann::ordered_json RenderOptionsUsed(const RenderArguments& arguments);

}  // namespace penumbra
