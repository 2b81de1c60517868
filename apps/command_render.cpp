// penumbra render: a picture of the light in a scene.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "apps/benchmark.h"
#include "apps/camera_arguments.h"
#include "apps/commands.h"
#include "apps/option_values.h"
#include "apps/output.h"
#include "apps/scene_arguments.h"
#include "apps/solve_run.h"
#include "display/image_io.h"
#include "display/two_pass_display.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

struct Mode {
  const char* name;
  MeshKind mesh;
  ShadingMode shading;
};
constexpr std::array<Mode, 5> kModes = {{{"flat", MeshKind::kFlat, ShadingMode::kRadiosity},
                                         {"gouraud", MeshKind::kGouraud, ShadingMode::kRadiosity},
                                         {"gouraud-mesh", MeshKind::kGouraudMesh, ShadingMode::kRadiosity},
                                         {"interpolant", MeshKind::kInterpolant, ShadingMode::kRadiosity},
                                         {"rho", MeshKind::kFlat, ShadingMode::kReflectance}}};

constexpr int kMaxPixels = 1 << 26;  // two gigabytes of buffers
constexpr int kMaxFrames = 1'000'000;

struct RenderArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::optional<std::string> output;
  Mode mode = kModes[3];
  int width = 1280, height = 960;
  std::optional<double> exposure;  // [m^2/W]; metered if not given
  int benchmark_frames = 0;        // 0: no benchmark
  int supersampling = 2;           // of PNG pictures: samples a side of a pixel
};

bool IsExr(const std::string& path) { return std::filesystem::path(path).extension() == ".exr"; }
bool IsPng(const std::string& path) { return std::filesystem::path(path).extension() == ".png"; }

// Reads WIDTHxHEIGHT.
bool ReadSize(std::string_view text, int* width, int* height) {
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, *width);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != 'x') return false;
  const auto second = std::from_chars(first.ptr + 1, end, *height);
  if (second.ec != std::errc() || second.ptr != end) return false;
  return *width > 0 && *height > 0 && *width <= kMaxPictureSize && *height <= kMaxPictureSize &&
         *height <= kMaxPixels / *width;
}

void SetMode(const std::string& name, Mode* mode) {
  std::string names;
  for (const Mode& candidate : kModes) {
    if (candidate.name == name) {
      *mode = candidate;
      return;
    }
    names += fmt::format("{}{}", names.empty() ? "" : ", ", candidate.name);
  }
  throw CLI::ValidationError("--mode", fmt::format("'{}' is none of {}", name, names));
}

// What can be told before the work starts.
void CheckOutputs(const RenderArguments& arguments) {
  if (!arguments.output && arguments.benchmark_frames == 0)
    throw UsageError("render needs -o IMAGE.png or -o IMAGE.exr, or --benchmark FRAMES");
  if (arguments.output) CheckWritable(*arguments.output);
  if (arguments.scene.report) CheckWritable(*arguments.scene.report);
  const int side = arguments.supersampling * std::max(arguments.width, arguments.height);
  if (arguments.output && IsPng(*arguments.output) &&
      (side > kMaxPictureSize ||
       arguments.supersampling * arguments.height > kMaxPixels / (arguments.supersampling * arguments.width)))
    throw UsageError(
        fmt::format("a picture of {}x{} is too large for a supersampling of {}; give --supersampling 1",
                    arguments.width, arguments.height, arguments.supersampling));
}

nlohmann::ordered_json RenderOptionsUsed(const RenderArguments& arguments) {
  nlohmann::ordered_json options;
  options["mode"] = arguments.mode.name;
  options["size"] = fmt::format("{}x{}", arguments.width, arguments.height);
  options["supersampling"] = arguments.supersampling;
  if (arguments.exposure)
    options["exposure"] = *arguments.exposure;
  else
    options["exposure"] = arguments.mode.shading == ShadingMode::kReflectance ? "1" : "metered";
  return options;
}

// The exposure for pictures from this camera; the display has drawn it afterwards.
double ExposureFor(const RenderArguments& arguments, const Camera& camera, TwoPassDisplay& display) {
  const RenderedFrame& frame =
      display.Render(camera, arguments.width, arguments.height, arguments.mode.shading);
  if (arguments.exposure) return *arguments.exposure;
  return arguments.mode.shading == ShadingMode::kReflectance ? 1 : MeterExposure(frame.linear, frame.kind);
}

// A PNG is drawn larger by the supersampling, exposed, and averaged: smooth edges. An EXR holds one value a
// pixel, that of its centre.
void WriteImage(const RenderArguments& arguments, const Camera& camera, const ToneMapping& tone,
                TwoPassDisplay& display) {
  const std::string& path = *arguments.output;
  const int k = arguments.supersampling;
  if (IsExr(path)) {
    WriteExr(path, display.frame().linear);
  } else if (k == 1) {
    WritePng(path, display.ToneMap(tone).screen);
  } else {
    const RenderedFrame& frame =
        display.Render(camera, k * arguments.width, k * arguments.height, arguments.mode.shading);
    Srgb8Image screen;
    EncodeSrgb(Downsample(Expose(frame.linear, frame.kind, tone.exposure), k), tone.dither, &screen);
    WritePng(path, screen);
  }
}

void Render(const RenderArguments& arguments) {
  CheckOutputs(arguments);
  const LoadedScene loaded = LoadScene(arguments.scene);
  const Camera camera = ChooseCamera(loaded.scene, arguments.camera);
  SolveRun run(arguments.scene, loaded, RenderOptionsUsed(arguments));
  run.Run(arguments.mode.mesh, WantsReport(arguments.scene));

  TwoPassDisplay display(loaded.scene, run.pipeline().mesh());
  ToneMapping tone;
  tone.exposure = ExposureFor(arguments, camera, display);
  if (arguments.output) WriteImage(arguments, camera, tone, display);
  run.Tell();
  if (arguments.benchmark_frames > 0)
    WriteResult(std::nullopt,
                RunBenchmark(display, {camera, arguments.width, arguments.height, arguments.benchmark_frames,
                                       arguments.mode.shading, tone}));
}

void AddPictureOptions(CLI::App& app, RenderArguments* arguments) {
  app.add_option_function<std::string>(
         "-o,--output",
         [arguments](const std::string& path) {
           if (!IsPng(path) && !IsExr(path))
             throw CLI::ValidationError("-o", fmt::format("'{}' ends neither in .png nor in .exr", path));
           arguments->output = path;
         },
         "The picture: .png is 8-bit sRGB, exposed, emitters white; .exr is linear radiosity in W/m^2, "
         "unexposed, emittance included")
      ->type_name("IMAGE.png|.exr");
  app.add_option_function<std::string>(
         "--mode", [arguments](const std::string& name) { SetMode(name, &arguments->mode); },
         "flat: one value an element; gouraud: exact irradiance at the elements' corners, linear between; "
         "gouraud-mesh: the same on the discontinuity mesh; interpolant: quadratic on that mesh, the "
         "two-pass "
         "display; rho: reflectance alone")
      ->type_name("MODE")
      ->default_str(arguments->mode.name)
      ->group("Picture");
  app.add_option_function<std::string>(
         "--size",
         [arguments](const std::string& text) {
           if (!ReadSize(text, &arguments->width, &arguments->height))
             throw CLI::ValidationError(
                 "--size",
                 fmt::format("'{}' is not WIDTHxHEIGHT, each from 1 to {} and at most {} pixels in all", text,
                             kMaxPictureSize, kMaxPixels));
         },
         "Width and height of the picture [pixels]")
      ->type_name("WxH")
      ->default_str(fmt::format("{}x{}", arguments->width, arguments->height))
      ->group("Picture");
  AddNumber(app, "--exposure", &arguments->exposure, kPositive,
            "Brightness on the screen, 0 to 1, per W/m^2 (default: metered from the picture; rho: 1)")
      ->group("Picture");
  AddInteger(app, "--supersampling", &arguments->supersampling, 1, 8,
             "Samples a side of each pixel of a PNG, averaged; an EXR has one, at the pixel's centre")
      ->group("Picture");
  AddInteger(app, "--benchmark", &arguments->benchmark_frames, 1, kMaxFrames,
             "Render N frames along an orbit of the camera and print fps and milliseconds as a line of JSON; "
             "-o may be left out")
      ->default_str("")
      ->group("Running");
}

}  // namespace

Command AddRenderCommand(CLI::App& program) {
  CLI::App* app = program.add_subcommand("render", "Draw a picture of the light in a scene");
  const auto arguments = std::make_shared<RenderArguments>();
  AddSceneArguments(*app, &arguments->scene);
  AddPictureOptions(*app, arguments.get());
  AddCameraOptions(*app, &arguments->camera);
  AddSolveOptions(*app, &arguments->scene);
  AddReportOption(*app, &arguments->scene);
  return {app, [arguments] { Render(*arguments); }};
}

}  // namespace penumbra
