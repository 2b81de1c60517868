// penumbra diff: how far a picture is from another.

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/commands.h"
#include "apps/interruptible.h"
#include "apps/option_values.h"
#include "apps/options_used.h"
#include "apps/output.h"
#include "apps/scene_arguments.h"
#include "display/exr_image.h"
#include "display/false_colour.h"
#include "display/image_difference.h"
#include "display/image_writers.h"
#include "solver/base/check.h"
#include "solver/base/file_endings.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

using Json = nlohmann::ordered_json;

struct DiffArguments {
  std::string reference, test;
  std::optional<std::string> output;
  double pixels_per_degree = kPixelsPerDegree;
  int threads = 0;
  std::uint64_t seed = PipelineOptions().seed;  // of nothing: every command takes one
  bool verbose = false;
  bool as_json = false;
};

constexpr const char* kChannels[3] = {"red", "green", "blue"};

RgbImage ReadPicture(const std::string& path) {
  RgbImage image = ReadExr(path);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const glm::vec3 pixel = image.At(x, y);
      if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y) || !std::isfinite(pixel.z))
        throw InputError(fmt::format(
            "{}: error: the pixel in column {}, row {} is no number; give a picture without such pixels",
            path, x, y));
    }
  return image;
}

std::string DiffJson(const RgbImage& image, const std::array<ChannelError, 3>& errors,
                     const VisibleDifference& visible) {
  Json relative;
  for (std::size_t c = 0; c < 3; ++c)
    relative[kChannels[c]] = {{"max", errors[c].max},
                              {"p99", errors[c].p99},
                              {"p95", errors[c].p95},
                              {"rms", errors[c].rms},
                              {"mean_ratio", errors[c].mean_ratio}};
  const Json json = {
      {"size", fmt::format("{}x{}", image.width, image.height)},
      {"relative", relative},
      {"flip", {{"mean", visible.mean}, {"max", visible.max}, {"exposures", visible.exposures.size()}}}};
  return json.dump(2) + "\n";
}

std::string DiffTable(const std::array<ChannelError, 3>& errors, const VisibleDifference& visible) {
  std::string table = "relative error         max        p99        p95        rms  mean ratio\n";
  for (std::size_t c = 0; c < 3; ++c)
    table += fmt::format("   {:<12} {:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g} {:>11.7g}\n", kChannels[c],
                         errors[c].max, errors[c].p99, errors[c].p95, errors[c].rms, errors[c].mean_ratio);
  return table + fmt::format("visible difference (FLIP, {} exposures): mean {:.4g}, max {:.4g}\n",
                             visible.exposures.size(), visible.mean, visible.max);
}

Json DiffOptionsUsed(const DiffArguments& arguments) {
  return {{"threads", ThreadCount()},
          {"seed", arguments.seed},
          {"pixels_per_degree", arguments.pixels_per_degree},
          {"json", arguments.as_json}};
}

void Diff(const DiffArguments& arguments) {
  SetThreadCount(arguments.threads);
  if (arguments.verbose) PrintOptionsUsed(DiffOptionsUsed(arguments));
  OutputFiles outputs;
  outputs.Add("-o", arguments.output);
  for (const std::string& picture : {arguments.reference, arguments.test}) outputs.RefuseInput(picture);
  const RgbImage reference = ReadPicture(arguments.reference), test = ReadPicture(arguments.test);
  if (reference.width != test.width || reference.height != test.height)
    throw InputError(fmt::format(
        "{}: error: it has {}x{} pixels, but {} has {}x{}; give pictures of one size", arguments.test,
        test.width, test.height, arguments.reference, reference.width, reference.height));
  const std::array<ChannelError, 3> errors = RelativeErrors(reference, test);
  VisibleDifference visible;
  RunInterruptible([&](const ExecutionContext& context) {
    visible = FindVisibleDifference(reference, test, arguments.pixels_per_degree, context);
  });
  if (arguments.output)
    WriteImageFile(*arguments.output, FalseColours(visible.map, reference.width, reference.height));
  WriteResult(std::nullopt,
              arguments.as_json ? DiffJson(reference, errors, visible) : DiffTable(errors, visible));
}

}  // namespace

Command AddDiffCommand(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("diff", "Tell how far a picture is from another, in numbers and to an eye");
  const auto arguments = std::make_shared<DiffArguments>();
  app->add_option("A", arguments->reference, "The reference, an EXR picture")->required()->type_name("");
  app->add_option("B", arguments->test, "The picture that is judged, an EXR of the same size")
      ->required()
      ->type_name("");
  app->add_option_function<std::string>(
         "-o,--output",
         [arguments](const std::string& path) {
           if (!IsScreenImage(path))
             throw CLI::ValidationError("-o", EndingError(path, ScreenImageEndings()));
           arguments->output = path;
         },
         "A map of the visible difference in false colours: black none, white all")
      ->type_name(fmt::format("MAP{}", fmt::join(Dotted(ScreenImageEndings()), "|")));
  AddNumber(*app, "--pixels-per-degree", &arguments->pixels_per_degree,
            NumberRule{[](double x) { return x >= 1 && x <= 1000; }, "a number from 1 to 1000"},
            "How far away the screen is: pixels in a degree of the view");
  app->add_flag("--json", arguments->as_json, "Print JSON");
  AddRunningOptions(*app, &arguments->threads, &arguments->seed, &arguments->verbose);
  app->footer(
      "Relative error, channel by channel: |b - a| / max(a, 1 % of the mean of a); mean ratio: mean of b / "
      "mean of a.\n"
      "Visible difference, 0 to 1 a pixel: FLIP (Andersson et al. 2020), the largest over exposures from "
      "the\n"
      "brightest to the median pixel of A (HDR-FLIP, 2021), cut off at white as the display does.");
  return {app, [arguments] { Diff(*arguments); }};
}

}  // namespace penumbra
