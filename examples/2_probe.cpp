// Example 2: probe points, as with a light meter.
//
//   example_2_probe

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "mesh/pipeline/pipeline.h"
#include "solver/base/check.h"
#include "solver/scene/named_scene.h"
#include "solver/transport/points/point_irradiance.h"

using namespace penumbra;

namespace {

constexpr int kGreen = 1;  // the channel that is printed

}  // namespace

int main() try {
  // 1. Solve a scene, as in example 1, and make the mesh with the interpolants.
  const Scene scene = ReadNamedScene("floating-cube", SceneOptions());
  const ExecutionContext context;
  PipelineOptions options;
  options.error = 0.05;
  Pipeline pipeline(scene, options);
  pipeline.Solve(context);
  pipeline.RefineLight(context);
  pipeline.BuildMesh(MeshKind::kInterpolant, context);

  // 2. Ask for irradiance on a surface. Patch 0 is the plane z = 0, for it is the first face of the scene.
  //    The exact value takes each light's visible part as a polygon; the interpolated value is read off the
  //    mesh. They differ by about the error that was asked for, or less.
  fmt::print("On the plane, green [W/m^2]\n{:>8} {:>10} {:>14} {:>10}\n", "x [m]", "exact", "interpolated",
             "direct");
  constexpr PatchId kPlane = 0;
  for (double x = -1.5; x <= 1.5; x += 0.5) {
    ReceiverPoint at;
    at.position = Vec3(x, 0.25, 0);
    at.normal = scene.patches[kPlane].normal;
    IrradianceParts parts;  // 3. what the irradiance is made of: direct light, gradient, light by patch
    const PointIrradianceResult exact = pipeline.irradiance().OnPatch(kPlane, at, &parts);
    const std::optional<Rgb> interpolated = pipeline.Interpolated(kPlane, at.position);
    fmt::print("{:8.2f} {:10.4f} {:14.4f} {:10.4f}\n", x, exact.irradiance[kGreen],
               interpolated ? (*interpolated)[kGreen] : 0, parts.direct[kGreen]);
  }

  // 4. Ask for irradiance in free space. The normal says which way the meter looks.
  ReceiverPoint meter;
  meter.position = Vec3(0, -1, 1);
  fmt::print("In free space, at (0, -1, 1)\n");
  for (const auto& [name, normal] : {std::pair("up", Vec3(0, 0, 1)), std::pair("down", Vec3(0, 0, -1)),
                                     std::pair("north", Vec3(0, 1, 0))}) {
    meter.normal = normal;
    fmt::print("{:>8} {:10.4f}\n", name, pipeline.irradiance().Anywhere(meter).irradiance[kGreen]);
  }
  return 0;
} catch (const InputError& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
