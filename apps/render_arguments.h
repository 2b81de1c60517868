// apps/render_arguments.h
//
// The options of `render` for the picture.

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

// The method by which a mode computes a pixel.
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

// The program or system that draws the two passes.
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
  bool false_colour = false;        // PNG: show values in false colours
  std::optional<double> scale_max;  // end of the scale [W/m^2]; default: what the exposure maps to white
  bool split = false;               // PNG: show the scratch images, too
  int benchmark_frames = 0;         // 0: no benchmark
  int supersampling = 2;            // PNG: samples per side of a pixel
  int samples = 1;                  // rays per pixel, for modes that cast rays

  bool ByRays() const { return mode.method != RenderMethod::kTwoPass; }
};

bool IsExr(const std::string& path);
bool IsPng(const std::string& path);

// Whether supersampling does not apply: the picture has one sample per pixel, or its mode casts rays.
bool HasOneSample(const RenderArguments& arguments);

void AddPictureOptions(CLI::App& app, RenderArguments* arguments);

// Checks the arguments before the work starts. Throws UsageError, or InputError if a file cannot be written.
void CheckRenderArguments(const RenderArguments& arguments);

// The options of the picture, in the format of OptionsUsed().
nlohmann::ordered_json RenderOptionsUsed(const RenderArguments& arguments);

}  // namespace penumbra
