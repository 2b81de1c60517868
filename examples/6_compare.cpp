// Example 6: compare two methods, and plot what they give.
//
// The quadratic interpolants of a discontinuity mesh against linear ones on the solver's own elements: both
// show irradiance along a line through two shadows, beside exact values.
//
//   example_6_compare [PLOT.svg]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "solver/base/check.h"
#include "solver/scene/named_scene.h"

using namespace penumbra;

namespace {

constexpr PatchId kPlane = 0;  // the scene's first face, z = 0
constexpr int kSamples = 400;

// 1. The line: points of the plane from x = -1.8 to x = 1.8, at y = 0.25.
Vec3 PointAt(int i) { return {-1.8 + 3.6 * (i + 0.5) / kSamples, 0.25, 0}; }

// 2. What a mesh shows along the line, in the green channel [W/m^2].
std::vector<double> Shown(const Pipeline& pipeline) {
  std::vector<double> values;
  for (int i = 0; i < kSamples; ++i)
    values.push_back(pipeline.Interpolated(kPlane, PointAt(i)).value_or(Rgb::Zero())[1]);
  return values;
}

std::vector<double> Exact(const Pipeline& pipeline) {
  std::vector<double> values;
  for (int i = 0; i < kSamples; ++i) {
    ReceiverPoint at;
    at.position = PointAt(i);
    values.push_back(pipeline.irradiance().OnPatch(kPlane, at).irradiance[1]);
  }
  return values;
}

// 3. How far a curve is from the exact one: root mean square and largest difference, relative to the mean.
double PrintError(const std::string& name, const std::vector<double>& shown,
                  const std::vector<double>& exact) {
  double squares = 0, largest = 0, mean = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double error = shown[i] - exact[i];
    squares += error * error / kSamples;
    largest = std::max(largest, std::abs(error));
    mean += exact[i] / kSamples;
  }
  fmt::print("{:<28} {:8.3f} % rms {:8.3f} % largest\n", name, 100 * std::sqrt(squares) / mean,
             100 * largest / mean);
  return std::sqrt(squares) / mean;
}

// 4. A curve of the plot, as a line of an SVG file.
constexpr int kWidth = 900, kHeight = 420;

std::string Curve(const std::vector<double>& values, double top, const char* colour, double width) {
  std::string points;
  for (std::size_t i = 0; i < values.size(); ++i)
    points += fmt::format("{:.2f},{:.2f} ", kWidth * (static_cast<double>(i) + 0.5) / kSamples,
                          kHeight * (1 - values[i] / top));
  return fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="{}"/>)"
                     "\n",
                     points, colour, width);
}

std::string Label(int line, const char* colour, const std::string& text) {
  return fmt::format(R"(<text x="12" y="{}" font-family="sans-serif" font-size="14" fill="{}">{}</text>)"
                     "\n",
                     20 * (line + 1), colour, text);
}

}  // namespace

int main(int argc, char** argv) try {
  // 5. Solve once, coarsely, so that the methods differ.
  const Scene scene = ReadNamedScene("floating-cube", SceneOptions());
  const ExecutionContext context;
  PipelineOptions options;
  options.error = 0.1;
  options.refine = RefineBy::kTransport;  // both meshes then show the same solution
  Pipeline pipeline(scene, options);
  pipeline.Solve(context);

  // 6. Refine the light, and show the solution in both ways.
  pipeline.RefineLight(context);
  pipeline.BuildMesh(MeshKind::kGouraud, context);
  const std::vector<double> linear = Shown(pipeline);
  pipeline.BuildMesh(MeshKind::kInterpolant, context);
  const std::vector<double> quadratic = Shown(pipeline), exact = Exact(pipeline);

  // 7. Compare.
  const double linear_error = PrintError("linear, solver's elements", linear, exact);
  const double quadratic_error = PrintError("quadratic, discontinuities", quadratic, exact);

  // 8. Plot.
  const std::string path = argc > 1 ? argv[1] : "compare.svg";
  const double top = 1.1 * *std::max_element(exact.begin(), exact.end());
  std::ofstream file(path);
  file << fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}">)", kWidth, kHeight)
       << Curve(exact, top, "#bbbbbb", 5) << Curve(linear, top, "#c0392b", 1.5)
       << Curve(quadratic, top, "#1f4e9c", 1.5) << Label(0, "#888888", "exact")
       << Label(1, "#c0392b", "linear, solver's elements")
       << Label(2, "#1f4e9c", "quadratic, discontinuities") << "</svg>\n";
  if (!file.flush()) throw InputError(path + ":0: error: cannot be written");
  fmt::print("wrote {}\n", path);
  return quadratic_error < linear_error ? 0 : 1;
} catch (const InputError& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
