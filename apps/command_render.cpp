// penumbra render: a picture of the light in a scene.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "apps/benchmark.h"
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

// The picture as a file, from across x down samples a pixel. An EXR holds their mean, and so do false
// colours; for a PNG each is exposed by itself, so that the edges of lights are smooth.
void WriteImage(const RenderArguments& arguments, const RgbImage& linear, std::span<const PixelKind> kinds,
                int across, int down, const ToneMapping& tone) {
  if (IsLinearImage(*arguments.output)) {
    const RgbImage means = Downsample(linear, across, down);
    for (const auto& plane : means.channel)
      if (!std::all_of(plane.begin(), plane.end(), [](float value) { return std::isfinite(value); }))
        throw InputError(
            fmt::format("{}: error: a pixel is no number that 32 bits hold, up to 3.4e38; give the "
                        "scene less light",
                        *arguments.output));
    WriteImageFile(*arguments.output, means);
    return;
  }
  Srgb8Image screen;
  if (arguments.false_colour) {
    PaintFalseColoursOf(arguments, {linear, kinds, across, down}, tone, &screen);
  } else {
    EncodeSrgb(Expose(linear, kinds, tone.exposure, across, down), tone.dither, &screen);
  }
  WriteImageFile(*arguments.output, screen);
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

// The picture in the quarter of its scratch images.
void WriteSplit(const RenderArguments& arguments, const Camera& camera, const IrradianceMesh& mesh,
                TwoPassDisplay& display, const ToneMapping& tone) {
  const int width = arguments.width, height = arguments.height;
  const int w = QuarterSide(width), h = QuarterSide(height);
  const RenderedFrame& frame = display.Render(camera, w, h, arguments.mode.shading);
  Srgb8Image picture, whole;
  if (arguments.false_colour)
    PaintFalseColoursOf(arguments, {frame.linear, frame.kind}, tone, &picture);
  else
    picture = display.ToneMap(tone).screen;
  whole.Resize(width, height);
  PaintSplit(frame, MakePixelRays(camera, w, h), mesh, picture, &whole);
  WriteImageFile(*arguments.output, whole);
}

// A PNG is drawn larger by the supersampling; an EXR has one sample a pixel, at its centre.
void RenderTwoPass(const RenderArguments& arguments, const Camera& camera, SolveRun& run) {
  const IrradianceMesh& mesh = run.pipeline().mesh();
  TwoPassDisplay display(run.pipeline().scene(), mesh, PassesOf(arguments, mesh));
  const int width = arguments.width, height = arguments.height;
  const ShadingMode shading = arguments.mode.shading;
  const RenderedFrame& frame = display.Render(camera, width, height, shading);
  const ToneMapping tone = ToneFor(arguments, frame.linear, frame.kind);
  if (arguments.split) {
    WriteSplit(arguments, camera, mesh, display, tone);
  } else if (arguments.output) {
    const int k = IsLinearImage(*arguments.output) || arguments.false_colour ? 1 : arguments.supersampling;
    if (k > 1) display.Render(camera, k * width, k * height, shading);
    WriteImage(arguments, frame.linear, frame.kind, k, k, tone);
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
                     arguments.mode.method == RenderMethod::kRayShade
                         ? RayShade(pipeline.scene(), pipeline.irradiance())
                         : LerpShade(pipeline.scene(), pipeline.mesh()),
                     arguments.samples);
  const SampledPicture& picture = display.picture();
  RunInterruptible([&](const ExecutionContext& context) {
    display.Render(camera, arguments.width, arguments.height, context);
  });
  const ToneMapping tone = ToneFor(arguments, picture.linear, picture.kind);
  if (arguments.output) WriteImage(arguments, picture.linear, picture.kind, picture.samples, 1, tone);
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
                  EncodeSrgb(Expose(picture.linear, picture.kind, tone.exposure, picture.samples),
                             tone.dither, &screen);
                  times.tone_map = 1e3 * mapping.Seconds();
                  return times;
                }));
}

void Render(RenderArguments arguments) {
  CheckRenderArguments(arguments);
  arguments.scene.outputs.Add("-o", arguments.output);
  arguments.scene.outputs.Add("--report", arguments.scene.report);
  // Whether there is OpenGL is told before the work.
  if (arguments.backend == Backend::kOpenGl) OpenGlPasses({}, arguments.coordinates);
  LoadedScene loaded = LoadToSolve(arguments.scene);
  const Camera camera = ChooseCamera(loaded.scene, arguments.camera);
  SolveRun run(arguments.scene, loaded, RenderOptionsUsed(arguments));
  // A report tells the interpolants' error even where the picture does without them.
  const bool measure = WantsReport(arguments.scene);
  if (arguments.mode.shading == ShadingMode::kReflectance && !measure)
    run.RunUnlit();
  else
    run.Run(measure && !arguments.mode.mesh ? MeshKind::kInterpolant : arguments.mode.mesh, measure);
  if (arguments.ByRays())
    RenderByRays(arguments, camera, run);
  else
    RenderTwoPass(arguments, camera, run);
}

}  // namespace

Command AddRenderCommand(CLI::App& program) {
  CLI::App* app = program.add_subcommand("render", "Draw a picture of the light in a scene");
  const auto arguments = std::make_shared<RenderArguments>();
  AddSceneArguments(*app, &arguments->scene);
  AddPictureOptions(*app, arguments.get());
  AddCameraOptions(*app, &arguments->camera, &arguments->scene.reading.up);
  AddDimOption(*app, &arguments->scene);
  AddSolveOptions(*app, &arguments->scene);
  AddPictureStudies(*app, arguments.get());
  AddRestartOption(*app, &arguments->scene);
  AddReportOption(*app, &arguments->scene);
  return {app, [arguments] { Render(*arguments); }};
}

}  // namespace penumbra
