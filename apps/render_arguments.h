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
#include "display/reconstruction.h"
#include "display/two_pass_display.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// The methods by which the colour of a pixel is computed.
enum class RenderMethod {
  kTwoPass,
  kRayShade,   // ray casting, with exact irradiance where a ray hits a surface
  kLerpShade,  // ray casting, with interpolated irradiance where a ray hits a surface
  // Ray casting, with irradiance that is reconstructed from the vertices of leaves (ReconstructedLight).
  kReconstruct,
};

struct RenderMode {
  const char* name;
  RenderMethod method;
  std::optional<MeshKind> mesh;
  ShadingMode shading;
  const char* help;
  Reconstruction reconstruction = {};  // the reconstruction that RenderMethod::kReconstruct draws
};
inline constexpr std::array<RenderMode, 11> kRenderModes = {
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
     {"rho", RenderMethod::kTwoPass, MeshKind::kFlat, ShadingMode::kReflectance, "reflectance alone"},
     {"nodal", RenderMethod::kReconstruct, std::nullopt, ShadingMode::kRadiosity,
      "means of the elements at each of their corners, bilinear between (Ashdown 1994)",
      Reconstruction::kNodal},
     {"gouraud-screen", RenderMethod::kReconstruct, std::nullopt, ShadingMode::kRadiosity,
      "the same means, linear along the rows of the picture (Gouraud 1971)", Reconstruction::kGouraudScreen},
     {"bilinear", RenderMethod::kReconstruct, std::nullopt, ShadingMode::kRadiosity,
      "exact irradiance at the elements' corners, bilinear between", Reconstruction::kBilinear},
     {"bicubic", RenderMethod::kReconstruct, std::nullopt, ShadingMode::kRadiosity,
      "the same, bicubic Hermite pieces (Bastos 1996)", Reconstruction::kBicubic}}};

// The back ends that draw the two passes of the display.
enum class Backend { kSoftware, kOpenGl };

struct RenderArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::optional<std::string> output;
  std::optional<std::string> path;  // the path of a file of cameras (ReadCameraPath)
  RenderMode mode = kRenderModes[3];
  Backend backend = Backend::kSoftware;
  OpenGlCoordinates coordinates = OpenGlCoordinates::kFloat;
  int width = 1280, height = 960;
  std::optional<double> exposure;  // exposure [m^2/W]; nullopt: MeterExposure() determines it
  bool false_colour = false;       // true if PNG pictures show false colours
  // The end of the false colour scale [W/m^2]; by default, the irradiance that the exposure shows as white.
  std::optional<double> scale_max;
  // True if PNG pictures show triangle ids, barycentric coordinates and depths in addition to the picture.
  bool split = false;
  int benchmark_frames = 0;  // number of benchmark frames; 0 for no benchmark
  int supersampling = 2;     // PNG pictures have supersampling^2 samples for each pixel
  int samples = 1;           // number of rays for each pixel, in modes that cast rays

  bool ByRays() const { return mode.method != RenderMethod::kTwoPass; }
};

// True if the picture is not supersampled: it has one sample per pixel, or it is made by ray casting.
bool HasOneSample(const RenderArguments& arguments);

void AddPictureOptions(CLI::App& app, RenderArguments* arguments);
// Adds the option --path. REQUIRES: AddCameraOptions() was called.
void AddPathOption(CLI::App& app, RenderArguments* arguments);
// Adds the picture options that serve only to compare methods; the help lists them in the group
// OptionGroup::kStudies. REQUIRES: AddSolveOptions() was called.
void AddPictureStudies(CLI::App& app, RenderArguments* arguments);

// Checks the arguments of the command `render` as far as possible before the computation starts. Throws
// UsageError if arguments contradict each other. Throws InputError if an output file cannot be written.
void CheckRenderArguments(const RenderArguments& arguments);

// The picture options of the command `render` as JSON, in the format of OptionsUsed().
nlohmann::ordered_json RenderOptionsUsed(const RenderArguments& arguments);

}  // namespace penumbra
