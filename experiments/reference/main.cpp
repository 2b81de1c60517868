// penumbra_reference: irradiance at points of a scene by path tracing, with standard errors.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

#include "apps/option_values.h"
#include "apps/output.h"
#include "apps/points_csv.h"
#include "experiments/reference/path_tracer.h"
#include "experiments/reference/reference_points.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/scene/named_scene.h"

namespace penumbra {
namespace {

struct Arguments {
  std::string scene;
  SceneOptions reading;
  std::optional<std::string> points, output;
  int spread = 400, threads = 0;
  PathTracerOptions tracing;
};

void AddArguments(CLI::App& app, Arguments* arguments) {
  app.add_option("SCENE", arguments->scene, "An OBJ file or the name of a built-in scene; a file wins")
      ->required();
  auto* points = app.add_option("--points", arguments->points, "CSV with the header x,y,z,nx,ny,nz");
  AddInteger(app, "--spread", &arguments->spread, 1, 1'000'000,
             "Without --points: so many points spread evenly over the fronts, clear of other faces")
      ->excludes(points);
  app.add_option("-o", arguments->output, "The result as CSV: x,y,z,nx,ny,nz,Er,Eg,Eb,sr,sg,sb,Dr,Dg,Db");
  AddNumber(app, "--target", &arguments->tracing.target, kPositive,
            "Standard error, relative to the irradiance, to be reached in each channel");
  AddInteger(app, "--max-paths", &arguments->tracing.max_paths, std::uint64_t{16384}, std::uint64_t{1} << 36,
             "Most paths a point, whether they reach the target or not");
  AddNumber(app, "--roulette", &arguments->tracing.roulette,
            NumberRule{[](double x) { return x > 0 && x <= 1; }, "a number in (0, 1]"},
            "Paths that would carry less go on with a probability only, carrying this");
  AddInteger(app, "--seed", &arguments->tracing.seed, std::uint64_t{0},
             std::numeric_limits<std::uint64_t>::max(), "Seed of the points and of the paths");
  AddInteger(app, "--threads", &arguments->threads, 0, 1024, "0: all; the result is the same for any number");
  app.add_flag("--emission-is-radiance", arguments->reading.emission_is_radiance, "Ke is radiance");
  app.add_flag("--two-sided", arguments->reading.two_sided, "Repeat every face, reversed, after the last");
}

std::vector<IrradiancePoint> PointsOf(const Arguments& arguments, const Scene& scene) {
  if (!arguments.points)
    return ReferencePoints(scene, static_cast<std::size_t>(arguments.spread), arguments.tracing.seed);
  std::vector<IrradiancePoint> points;
  for (const ProbePoint& point : ReadPointsCsv(*arguments.points)) {
    if (!(point.normal.norm() > 0))
      throw InputError(*arguments.points + ":0: error: a normal is zero; give one");
    points.push_back({point.position, point.normal.stableNormalized()});
  }
  return points;
}

std::string Csv(const std::vector<IrradiancePoint>& points, const std::vector<ReferenceIrradiance>& found) {
  std::string text = "x,y,z,nx,ny,nz,Er,Eg,Eb,sr,sg,sb,Dr,Dg,Db\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 &p = points[i].position, &n = points[i].normal;
    text += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}", p.x(), p.y(), p.z(), n.x(), n.y(),
                        n.z());
    for (const Rgb& value : {found[i].total, found[i].error, found[i].direct})
      text += fmt::format(",{:.9g},{:.9g},{:.9g}", value[0], value[1], value[2]);
    text += '\n';
  }
  return text;
}

void Tell(const std::vector<ReferenceIrradiance>& found, double target, double seconds) {
  std::size_t reached = 0, dark = 0;
  std::uint64_t rays = 0, paths = 0;
  double worst = 0;
  for (const ReferenceIrradiance& at : found) {
    rays += at.rays;
    paths += at.paths;
    reached += (at.error <= target * at.total).all() ? 1 : 0;
    dark += (at.total <= 0).all() ? 1 : 0;
    for (int c = 0; c < 3; ++c)
      if (at.total[c] > 0) worst = std::max(worst, at.error[c] / at.total[c]);
  }
  fmt::print(stderr,
             "{} points, {} of them dark, {} within {}, worst {:.3g}; {:.3g} paths, {:.3g} rays, {:.1f} s\n",
             found.size(), dark, reached, target, worst, static_cast<double>(paths),
             static_cast<double>(rays), seconds);
}

int Main(int argc, char** argv) {
  CLI::App app("Irradiance at points of a scene by path tracing, with standard errors", "penumbra_reference");
  Arguments arguments;
  AddArguments(app, &arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "penumbra_reference: error: {}; see `penumbra_reference --help`\n", error.what());
    return 2;
  }
  try {
    SetThreadCount(arguments.threads);
    if (arguments.output) CheckWritable(*arguments.output);
    const Scene scene = ReadNamedScene(arguments.scene, arguments.reading);
    const std::vector<IrradiancePoint> points = PointsOf(arguments, scene);
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<ReferenceIrradiance> found = PathTracer(scene, arguments.tracing).At(points);
    Tell(found, arguments.tracing.target,
         std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    WriteResult(arguments.output, Csv(points, found));
    return 0;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) { return penumbra::Main(argc, argv); }
