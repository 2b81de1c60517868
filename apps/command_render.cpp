// penumbra render: a picture of the light in a scene.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/benchmark.h"
#include "apps/camera_path.h"
#include "apps/commands.h"
#include "apps/dim_option.h"
#include "apps/interruptible.h"
#include "apps/output.h"
#include "apps/render_arguments.h"
#include "apps/restart.h"
#include "apps/solve_options.h"
#include "apps/solve_run.h"
#include "display/false_colour.h"
#include "display/image_writers.h"
#include "display/ray_display.h"
#include "display/reconstruction.h"
#include "display/split_view.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"

namespace penumbra {
namespace {

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

// A picture with several samples a pixel.
struct PictureSamples {
  const RgbImage& linear;            // of all samples
  std::span<const PixelKind> kinds;  // the same
  int across = 1, down = 1;          // samples a pixel
};

// The means of each pixel's samples in false colours, with their scale; what it shows is what its first
// sample is.
void PaintFalseColoursOf(const RenderArguments& arguments, const PictureSamples& picture,
                         const ToneMapping& tone, Srgb8Image* screen) {
  const auto& [linear, kinds, across, down] = picture;
  const RgbImage means = Downsample(linear, across, down);
  std::vector<PixelKind> first(means.PixelCount());
  for (int y = 0; y < means.height; ++y)
    for (int x = 0; x < means.width; ++x)
      first[means.Index(x, y)] = kinds[linear.Index(across * x, down * y)];
  const double top = arguments.scale_max.value_or(1 / tone.exposure);
  PaintFalseColours(means, first, top, screen);
  PaintLegend(top, arguments.mode.shading == ShadingMode::kRadiosity ? "W/m^2" : "1", screen);
}

// The picture as a file, from several samples a pixel. An EXR holds their mean, and so do false colours; for
// a PNG each is exposed by itself, so that the edges of lights are smooth.
void WriteImage(const RenderArguments& arguments, const PictureSamples& picture, const ToneMapping& tone,
                const std::string& output) {
  const auto& [linear, kinds, across, down] = picture;
  if (IsLinearImage(output)) {
    const RgbImage means = Downsample(linear, across, down);
    for (const auto& plane : means.channel)
      if (!std::all_of(plane.begin(), plane.end(), [](float value) { return std::isfinite(value); }))
        throw InputError(
            fmt::format("{}: error: a pixel is no number that 32 bits hold, up to 3.4e38; give the "
                        "scene less light",
                        output));
    WriteImageFile(output, means);
    return;
  }
  Srgb8Image screen;
  if (arguments.false_colour) {
    PaintFalseColoursOf(arguments, picture, tone, &screen);
  } else {
    EncodeSrgb(Expose(linear, kinds, tone.exposure, across, down), tone.dither, &screen);
  }
  WriteImageFile(output, screen);
}

BenchmarkSettings BenchmarkOf(const RenderArguments& arguments, const Camera& camera,
                              const Pipeline& pipeline) {
  BenchmarkSettings settings{camera, arguments.width, arguments.height, arguments.benchmark_frames, 0};
  if (arguments.mode.mesh) settings.triangles = pipeline.mesh().triangles.size();
  return settings;
}

std::unique_ptr<Passes> PassesOf(const RenderArguments& arguments, const IrradianceMesh& mesh) {
  return arguments.backend == Backend::kOpenGl ? OpenGlPasses(mesh, arguments.coordinates)
                                               : SoftwarePasses(mesh);
}

// A picture to draw, and its file, if there is one.
struct Shot {
  Camera camera;
  std::optional<std::string> output;
};

// One shot, or one for each camera of --path.
std::vector<Shot> ShotsOf(const RenderArguments& arguments, const Scene& scene) {
  const Camera camera = ChooseCamera(scene, arguments.camera);
  if (!arguments.path) return {{camera, arguments.output}};
  std::vector<Shot> shots;
  const std::vector<Camera> cameras = ReadCameraPath(*arguments.path, camera);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    shots.push_back({cameras[i], FramePath(*arguments.output, i, cameras.size())});
    CheckWritable(*shots.back().output);
  }
  return shots;
}

// The picture in the quarter of its scratch images.
void WriteSplit(const RenderArguments& arguments, const Shot& shot, const IrradianceMesh& mesh,
                TwoPassDisplay& display, const ToneMapping& tone) {
  const int width = arguments.width, height = arguments.height;
  const int w = QuarterSide(width), h = QuarterSide(height);
  const RenderedFrame& frame = display.Render(shot.camera, w, h, arguments.mode.shading);
  Srgb8Image picture, whole;
  if (arguments.false_colour)
    PaintFalseColoursOf(arguments, {frame.linear, frame.kind}, tone, &picture);
  else
    picture = display.ToneMap(tone).screen;
  whole.Resize(width, height);
  PaintSplit(frame, MakePixelRays(shot.camera, w, h), mesh, picture, &whole);
  WriteImageFile(*shot.output, whole);
}

// A PNG is drawn larger by the supersampling; an EXR has one sample a pixel, at its centre. All pictures of a
// path have the exposure of the first.
void RenderTwoPass(const RenderArguments& arguments, const std::vector<Shot>& shots, SolveRun& run) {
  const IrradianceMesh& mesh = run.pipeline().mesh();
  TwoPassDisplay display(run.pipeline().scene(), mesh, PassesOf(arguments, mesh));
  const int width = arguments.width, height = arguments.height;
  const ShadingMode shading = arguments.mode.shading;
  std::optional<ToneMapping> tone;
  for (const Shot& shot : shots) {
    const RenderedFrame& frame = display.Render(shot.camera, width, height, shading);
    if (!tone) tone = ToneFor(arguments, frame.linear, frame.kind);
    if (arguments.split) {
      WriteSplit(arguments, shot, mesh, display, *tone);
    } else if (shot.output) {
      const int k = IsLinearImage(*shot.output) || arguments.false_colour ? 1 : arguments.supersampling;
      if (k > 1) display.Render(shot.camera, k * width, k * height, shading);
      WriteImage(arguments, {frame.linear, frame.kind, k, k}, *tone, *shot.output);
    }
  }
  run.Tell();
  if (arguments.benchmark_frames > 0)
    WriteResult(
        std::nullopt,
        RunBenchmark(BenchmarkOf(arguments, shots.front().camera, run.pipeline()), [&](const Camera& from) {
          return display.RenderScreen(from, width, height, shading, *tone).ms;
        }));
}

// Makes the shader of a picture from a camera.
using ShaderOfCamera = std::function<RayShader(const Camera&)>;

ShaderOfCamera ShadersOf(const RenderArguments& arguments, const Pipeline& pipeline) {
  if (arguments.mode.method == RenderMethod::kReconstruct) {
    std::shared_ptr<const ReconstructedLight> light;
    RunInterruptible([&](const ExecutionContext& context) {
      light = std::make_shared<const ReconstructedLight>(
          ReconstructLight(arguments.mode.reconstruction, pipeline, context));
    });
    return [light, width = arguments.width, height = arguments.height](const Camera& camera) {
      return light->Shade(camera, width, height);
    };
  }
  const RayShader shader = arguments.mode.method == RenderMethod::kRayShade
                               ? RayShade(pipeline.scene(), pipeline.irradiance())
                               : LerpShade(pipeline.scene(), pipeline.mesh());
  return [shader](const Camera&) { return shader; };
}

void RenderByRays(const RenderArguments& arguments, const std::vector<Shot>& shots, SolveRun& run) {
  const Pipeline& pipeline = run.pipeline();
  const ShaderOfCamera shaders = ShadersOf(arguments, pipeline);
  RayDisplay display(pipeline.scene(), shaders(shots.front().camera), arguments.samples);
  const SampledPicture& picture = display.picture();
  const auto draw = [&](const Camera& camera) {
    display.SetShader(shaders(camera));
    RunInterruptible([&](const ExecutionContext& context) {
      display.Render(camera, arguments.width, arguments.height, context);
    });
  };
  std::optional<ToneMapping> tone;
  for (const Shot& shot : shots) {
    draw(shot.camera);
    if (!tone) tone = ToneFor(arguments, picture.linear, picture.kind);
    if (shot.output)
      WriteImage(arguments, {picture.linear, picture.kind, picture.samples, 1}, *tone, *shot.output);
  }
  run.Tell();
  if (arguments.benchmark_frames > 0)
    WriteResult(std::nullopt,
                RunBenchmark(BenchmarkOf(arguments, shots.front().camera, pipeline), [&](const Camera& from) {
                  FrameTimes times;
                  const Stopwatch casting;
                  draw(from);
                  times.evaluate = 1e3 * casting.Seconds();
                  const Stopwatch mapping;
                  Srgb8Image screen;
                  EncodeSrgb(Expose(picture.linear, picture.kind, tone->exposure, picture.samples),
                             tone->dither, &screen);
                  times.tone_map = 1e3 * mapping.Seconds();
                  return times;
                }));
}

void Render(RenderArguments arguments) {
  CheckRenderArguments(arguments);
  arguments.scene.outputs.Add("-o", arguments.output);
  arguments.scene.outputs.Add("--report", arguments.scene.report);
  if (arguments.path) arguments.scene.outputs.RefuseInput(*arguments.path);
  // Whether there is OpenGL is told before the work.
  if (arguments.backend == Backend::kOpenGl) OpenGlPasses({}, arguments.coordinates);
  LoadedScene loaded = LoadToSolve(arguments.scene);
  const std::vector<Shot> shots = ShotsOf(arguments, loaded.scene);
  SolveRun run(arguments.scene, loaded, RenderOptionsUsed(arguments));
  // A report tells the interpolants' error even where the picture does without them.
  const bool measure = WantsReport(arguments.scene);
  if (arguments.mode.shading == ShadingMode::kReflectance && !measure)
    run.RunUnlit();
  else
    run.Run(measure && !arguments.mode.mesh ? MeshKind::kInterpolant : arguments.mode.mesh, measure);
  if (arguments.ByRays())
    RenderByRays(arguments, shots, run);
  else
    RenderTwoPass(arguments, shots, run);
}

}  // namespace

Command AddRenderCommand(CLI::App& program) {
  CLI::App* app = program.add_subcommand("render", "Draw a picture of the light in a scene");
  const auto arguments = std::make_shared<RenderArguments>();
  AddSceneArguments(*app, &arguments->scene);
  AddPictureOptions(*app, arguments.get());
  AddCameraOptions(*app, &arguments->camera, &arguments->scene.reading.up);
  AddPathOption(*app, arguments.get());
  AddDimOption(*app, &arguments->scene);
  AddSolveOptions(*app, &arguments->scene);
  AddPictureStudies(*app, arguments.get());
  AddRestartOption(*app, &arguments->scene);
  AddReportOption(*app, &arguments->scene);
  return {app, [arguments] { Render(*arguments); }};
}

}  // namespace penumbra
