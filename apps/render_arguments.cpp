#include "apps/render_arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <system_error>

#include "apps/commands.h"
#include "apps/option_values.h"
#include "apps/output.h"
#include "display/image_writers.h"
#include "mesh/pipeline/option_table.h"
#include "solver/base/file_endings.h"

namespace penumbra {
namespace {

constexpr int kMaxPixels = 1 << 26;  // two gigabytes of buffers
constexpr int kMaxFrames = 1'000'000;
constexpr int kMaxSamples = 1024;

constexpr Choice<Backend> kBackends[] = {{"software", Backend::kSoftware}, {"opengl", Backend::kOpenGl}};
constexpr Choice<OpenGlCoordinates> kCoordinates[] = {{"float", OpenGlCoordinates::kFloat},
                                                      {"8bit", OpenGlCoordinates::kTexture}};

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

void SetMode(const std::string& name, RenderMode* mode) {
  std::string names;
  for (const RenderMode& candidate : kRenderModes) {
    if (candidate.name == name) {
      *mode = candidate;
      return;
    }
    names += fmt::format("{}{}", names.empty() ? "" : ", ", candidate.name);
  }
  throw CLI::ValidationError("--mode", fmt::format("'{}' is none of {}", name, names));
}

// What each mode shows.
std::string ModeHelp() {
  std::vector<std::string> modes;
  for (const RenderMode& mode : kRenderModes) modes.push_back(fmt::format("{}: {}", mode.name, mode.help));
  return fmt::format("{}", fmt::join(modes, "; "));
}

// What each format holds.
std::string PictureHelp() {
  std::vector<std::string> formats;
  for (const ImageWriterRegistry::Method& format : ImageWriters().methods())
    formats.push_back(fmt::format(".{} is {}", format.name, format.help));
  return fmt::format("The picture: {}", fmt::join(formats, "; "));
}

}  // namespace

void CheckRenderArguments(const RenderArguments& arguments) {
  if (!arguments.output && arguments.benchmark_frames == 0)
    throw UsageError(fmt::format("render needs -o IMAGE{}, or --benchmark FRAMES",
                                 fmt::join(Dotted(ImageWriters().Names()), " or -o IMAGE")));
  if (arguments.split && arguments.false_colour)
    throw UsageError(
        "--split shows the passes and their picture, --false-colour values; leave one of them out");
  const auto given = [&](const char* name) { return arguments.scene.app->get_option(name)->count() > 0; };
  if (given("--opengl-coordinates") && arguments.backend != Backend::kOpenGl)
    throw UsageError("--opengl-coordinates is of --backend opengl; give both, or none");
  if (arguments.samples > 1 && !arguments.ByRays())
    throw UsageError(
        fmt::format("--samples is of modes that cast rays, and --mode {} does not; give --supersampling",
                    arguments.mode.name));
  if (given("--supersampling") && arguments.supersampling > 1 && HasOneSample(arguments))
    throw UsageError(
        "--supersampling is of PNG pictures by the two passes, without --false-colour or --split; leave it "
        "out");
  for (const char* other : {"--eye", "--look-at", "--benchmark"})
    if (arguments.path && given(other))
      throw UsageError(fmt::format("--path has the cameras of all pictures; leave out {}", other));
  if (arguments.path && !arguments.output)
    throw UsageError("--path draws pictures; give the beginning of their names by -o IMAGE");
  if (arguments.scale_max && !arguments.false_colour)
    throw UsageError("--scale-max is the end of --false-colour's scale; give both");
  if ((arguments.false_colour || arguments.split) && (!arguments.output || !IsScreenImage(*arguments.output)))
    throw UsageError(fmt::format("{} shows something else than radiosity and wants -o IMAGE{}",
                                 arguments.split ? "--split" : "--false-colour",
                                 fmt::join(Dotted(ScreenImageEndings()), " or -o IMAGE")));
  if (arguments.ByRays()) {
    if (arguments.split || arguments.backend == Backend::kOpenGl)
      throw UsageError(fmt::format("--mode {} casts rays and has no passes; leave out {}",
                                   arguments.mode.name, arguments.split ? "--split" : "--backend opengl"));
    if (arguments.samples > kMaxPixels / arguments.height / arguments.width)
      throw UsageError(fmt::format("{} samples of {}x{} pixels are too many; give a smaller --samples",
                                   arguments.samples, arguments.width, arguments.height));
    return;
  }
  const int side = arguments.supersampling * std::max(arguments.width, arguments.height);
  if (arguments.output && IsScreenImage(*arguments.output) &&
      (side > kMaxPictureSize ||
       arguments.supersampling * arguments.height > kMaxPixels / (arguments.supersampling * arguments.width)))
    throw UsageError(
        fmt::format("a picture of {}x{} is too large for a supersampling of {}; give --supersampling 1",
                    arguments.width, arguments.height, arguments.supersampling));
}

bool HasOneSample(const RenderArguments& arguments) {
  return arguments.ByRays() || arguments.false_colour || arguments.split ||
         (arguments.output && IsLinearImage(*arguments.output));
}

nlohmann::ordered_json RenderOptionsUsed(const RenderArguments& arguments) {
  nlohmann::ordered_json options;
  options["mode"] = arguments.mode.name;
  if (arguments.path) options["path"] = *arguments.path;
  options["size"] = fmt::format("{}x{}", arguments.width, arguments.height);
  if (arguments.ByRays()) {
    options["samples"] = arguments.samples;
  } else {
    if (!HasOneSample(arguments)) options["supersampling"] = arguments.supersampling;
    options["backend"] = ChoiceName(kBackends, arguments.backend);
    if (arguments.backend == Backend::kOpenGl)
      options["opengl_coordinates"] = ChoiceName(kCoordinates, arguments.coordinates);
  }
  if (arguments.exposure) options["exposure"] = *arguments.exposure;
  options["false_colour"] = arguments.false_colour;
  if (arguments.scale_max) options["scale_max"] = *arguments.scale_max;
  options["split"] = arguments.split;
  return options;
}

namespace {

// What is written, and what is drawn.
void AddFileAndMode(CLI::App& app, RenderArguments* arguments) {
  app.add_option_function<std::string>(
         "-o,--output",
         [arguments](const std::string& path) {
           if (!FindByEnding(ImageWriters(), path))
             throw CLI::ValidationError("-o", EndingError(path, ImageWriters().Names()));
           arguments->output = path;
         },
         PictureHelp())
      ->type_name(fmt::format("IMAGE{}", fmt::join(Dotted(ImageWriters().Names()), "|")));
  app.add_option_function<std::string>(
         "--mode", [arguments](const std::string& name) { SetMode(name, &arguments->mode); }, ModeHelp())
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
}

// How light becomes colours.
void AddColours(CLI::App& app, RenderArguments* arguments) {
  AddNumber(app, "--exposure", &arguments->exposure, kPositive,
            "Brightness on the screen, 0 to 1, per W/m^2 (default: metered from the picture; rho: 1)")
      ->group("Picture");
  app.add_flag("--false-colour,--false-color", arguments->false_colour,
               "A PNG shows the mean of the channels in false colours, with a scale in W/m^2 (rho: 1)")
      ->group("Picture");
  AddNumber(app, "--scale-max", &arguments->scale_max, kPositive,
            "The end of that scale [W/m^2] (default: what the exposure makes white)")
      ->group("Picture");
  app.add_flag("--split", arguments->split,
               "A PNG shows triangle ids, barycentric coordinates, depths and the picture, in quarters")
      ->group("Picture");
}

}  // namespace

void AddPictureOptions(CLI::App& app, RenderArguments* arguments) {
  AddFileAndMode(app, arguments);
  AddColours(app, arguments);
  AddChoice(app, "--backend", &arguments->backend, kBackends,
            "What draws the two passes: our rasteriser, or the graphics system, off screen, as in the thesis")
      ->group("Picture");
  AddInteger(
      app, "--supersampling", &arguments->supersampling, 1, 8,
      "Samples a side of each pixel of a PNG, averaged; an EXR, false colours and --split have one, at the "
      "pixel's centre; modes that cast rays: see --samples")
      ->group("Picture");
  AddInteger(app, "--samples", &arguments->samples, 1, kMaxSamples,
             "Of modes that cast rays (exact, lerp, nodal, ...): rays a pixel, averaged; the first goes "
             "through its centre")
      ->group("Picture");
  AddInteger(app, "--benchmark", &arguments->benchmark_frames, 1, kMaxFrames,
             "Render N frames along an orbit of the camera and print fps and milliseconds as a line of JSON; "
             "-o may be left out")
      ->default_str("")
      ->group("Running");
}

void AddPathOption(CLI::App& app, RenderArguments* arguments) {
  app.add_option("--path", arguments->path,
                 "A file of cameras, one a line: EYE LOOK-AT [UP [FOV]], points as x,y,z. -o walk.png then "
                 "writes walk-0000.png and so on, all with the exposure of the first")
      ->type_name("FILE")
      ->group("Camera");
}

void AddPictureStudies(CLI::App& app, RenderArguments* arguments) {
  AddChoice(
      app, "--opengl-coordinates", &arguments->coordinates, kCoordinates,
      "opengl: barycentric coordinates as floats, or from the thesis's texture of 256 x 256 texels of 8 "
      "bits")
      ->group(GroupTitle(OptionGroup::kStudies));
}

}  // namespace penumbra
