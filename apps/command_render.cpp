// penumbra render: a picture of the light in a scene.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "apps/benchmark.h"
#include "apps/camera_arguments.h"
#include "apps/commands.h"
#include "apps/interruptible.h"
#include "apps/option_values.h"
#include "apps/output.h"
#include "apps/scene_arguments.h"
#include "apps/solve_run.h"
#include "display/image_io.h"
#include "display/ray_display.h"
#include "display/two_pass_display.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"

namespace penumbra {
namespace {

// How a mode finds what a pixel shows.
enum class Method {
  kTwoPass,
  kRayShade,   // rays, exact irradiance
  kLerpShade,  // rays, interpolants
};

struct Mode {
  const char* name;
  Method method;
  std::optional<MeshKind> mesh;
  ShadingMode shading;
};
constexpr std::array<Mode, 7> kModes = {
    {{"flat", Method::kTwoPass, MeshKind::kFlat, ShadingMode::kRadiosity},
     {"gouraud", Method::kTwoPass, MeshKind::kGouraud, ShadingMode::kRadiosity},
     {"gouraud-mesh", Method::kTwoPass, MeshKind::kGouraudMesh, ShadingMode::kRadiosity},
     {"interpolant", Method::kTwoPass, MeshKind::kInterpolant, ShadingMode::kRadiosity},
     {"exact", Method::kRayShade, std::nullopt, ShadingMode::kRadiosity},
     {"lerp", Method::kLerpShade, MeshKind::kInterpolant, ShadingMode::kRadiosity},
     {"rho", Method::kTwoPass, MeshKind::kFlat, ShadingMode::kReflectance}}};

constexpr int kMaxPixels = 1 << 26;  // two gigabytes of buffers
constexpr int kMaxFrames = 1'000'000;
constexpr int kMaxSamples = 1024;

struct RenderArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::optional<std::string> output;
  Mode mode = kModes[3];
  int width = 1280, height = 960;
  std::optional<double> exposure;  // [m^2/W]; metered if not given
  int benchmark_frames = 0;        // 0: no benchmark
  int supersampling = 2;           // of PNG pictures: samples a side of a pixel
  int samples = 1;                 // rays a pixel, where a mode casts rays

  bool ByRays() const { return mode.method != Method::kTwoPass; }
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
  if (arguments.ByRays()) {
    if (arguments.samples > kMaxPixels / arguments.height / arguments.width)
      throw UsageError(fmt::format("{} samples of {}x{} pixels are too many; give a smaller --samples",
                                   arguments.samples, arguments.width, arguments.height));
    return;
  }
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
  if (arguments.ByRays())
    options["samples"] = arguments.samples;
  else
    options["supersampling"] = arguments.supersampling;
  if (arguments.exposure)
    options["exposure"] = *arguments.exposure;
  else
    options["exposure"] = arguments.mode.shading == ShadingMode::kReflectance ? "1" : "metered";
  return options;
}

// The exposure to show a picture with.
ToneMapping ToneFor(const RenderArguments& arguments, const RgbImage& linear,
                    std::span<const PixelKind> kinds) {
  ToneMapping tone;
  if (arguments.exposure)
    tone.exposure = *arguments.exposure;
  else if (arguments.mode.shading == ShadingMode::kRadiosity)
    tone.exposure = MeterExposure(linear, kinds);
  return tone;
}

// The picture as a file, from across x down samples a pixel. An EXR holds their mean; for a PNG each is
// exposed by itself, so that the edges of lights are smooth.
void WriteImage(const std::string& path, const RgbImage& linear, std::span<const PixelKind> kinds, int across,
                int down, const ToneMapping& tone) {
  if (IsExr(path)) {
    WriteExr(path, Downsample(linear, across, down));
  } else {
    Srgb8Image screen;
    EncodeSrgb(Downsample(Expose(linear, kinds, tone.exposure), across, down), tone.dither, &screen);
    WritePng(path, screen);
  }
}

BenchmarkSettings BenchmarkOf(const RenderArguments& arguments, const Camera& camera,
                              const Pipeline& pipeline) {
  BenchmarkSettings settings{camera, arguments.width, arguments.height, arguments.benchmark_frames, 0};
  if (arguments.mode.mesh) settings.triangles = pipeline.mesh().triangles.size();
  return settings;
}

// A PNG is drawn larger by the supersampling; an EXR has one sample a pixel, at its centre.
void RenderTwoPass(const RenderArguments& arguments, const Camera& camera, SolveRun& run) {
  TwoPassDisplay display(run.pipeline().scene(), run.pipeline().mesh());
  const int width = arguments.width, height = arguments.height;
  const ShadingMode shading = arguments.mode.shading;
  const RenderedFrame& frame = display.Render(camera, width, height, shading);
  const ToneMapping tone = ToneFor(arguments, frame.linear, frame.kind);
  if (arguments.output) {
    const int k = IsExr(*arguments.output) ? 1 : arguments.supersampling;
    if (k > 1) display.Render(camera, k * width, k * height, shading);
    WriteImage(*arguments.output, frame.linear, frame.kind, k, k, tone);
  }
  run.Tell();
  if (arguments.benchmark_frames > 0)
    WriteResult(std::nullopt,
                RunBenchmark(BenchmarkOf(arguments, camera, run.pipeline()), [&](const Camera& from) {
                  return display.RenderScreen(from, width, height, shading, tone).ms;
                }));
}

void RenderByRays(const RenderArguments& arguments, const Camera& camera, SolveRun& run) {
  const Pipeline& pipeline = run.pipeline();
  RayDisplay display(pipeline.scene(),
                     arguments.mode.method == Method::kRayShade
                         ? RayShade(pipeline.scene(), pipeline.irradiance())
                         : LerpShade(pipeline.scene(), pipeline.mesh()),
                     arguments.samples);
  const SampledPicture& picture = display.picture();
  RunInterruptible([&](const ExecutionContext& context) {
    display.Render(camera, arguments.width, arguments.height, context);
  });
  const ToneMapping tone = ToneFor(arguments, picture.linear, picture.kind);
  if (arguments.output) WriteImage(*arguments.output, picture.linear, picture.kind, picture.samples, 1, tone);
  run.Tell();
  if (arguments.benchmark_frames > 0)
    WriteResult(std::nullopt, RunBenchmark(BenchmarkOf(arguments, camera, pipeline), [&](const Camera& from) {
                  FrameTimes times;
                  const Stopwatch casting;
                  RunInterruptible([&](const ExecutionContext& context) {
                    display.Render(from, arguments.width, arguments.height, context);
                  });
                  times.evaluate = 1e3 * casting.Seconds();
                  const Stopwatch mapping;
                  Srgb8Image screen;
                  EncodeSrgb(
                      Downsample(Expose(picture.linear, picture.kind, tone.exposure), picture.samples, 1),
                      tone.dither, &screen);
                  times.tone_map = 1e3 * mapping.Seconds();
                  return times;
                }));
}

void Render(const RenderArguments& arguments) {
  CheckOutputs(arguments);
  LoadedScene loaded = LoadScene(arguments.scene);
  const Camera camera = ChooseCamera(loaded.scene, arguments.camera);
  SolveRun run(arguments.scene, loaded, RenderOptionsUsed(arguments));
  // A report tells the interpolants' error even where the picture does without them.
  const bool measure = WantsReport(arguments.scene);
  run.Run(measure && !arguments.mode.mesh ? MeshKind::kInterpolant : arguments.mode.mesh, measure);
  if (arguments.ByRays())
    RenderByRays(arguments, camera, run);
  else
    RenderTwoPass(arguments, camera, run);
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
         "two-pass display; exact: exact irradiance at every pixel, by rays (RayShade); lerp: the "
         "interpolant, "
         "found by rays (LerpShade); rho: reflectance alone")
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
  AddInteger(
      app, "--supersampling", &arguments->supersampling, 1, 8,
      "Samples a side of each pixel of a PNG, averaged; an EXR has one, at the pixel's centre; exact and "
      "lerp: see --samples")
      ->group("Picture");
  AddInteger(app, "--samples", &arguments->samples, 1, kMaxSamples,
             "exact, lerp: rays a pixel, averaged; the first goes through its centre")
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
