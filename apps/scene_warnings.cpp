#include "apps/scene_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "solver/transport/solvers/diagnostics.h"

namespace penumbra {
namespace {

// Rays that look for what is lit from behind: a tenth of a second, and enough from each patch for a majority
// by area.
constexpr std::size_t kRays = std::size_t{1} << 17, kFewestRays = 4, kMostRays = 64;

// Nothing that is built is so thick, wide and high [m]; a room in millimetres is. Where the ground lies and
// how far it goes plays no part: sites in map coordinates are wide, and flat.
constexpr double kThickest = 400;
// Nor is a scene of so few details [m] that is so large.
constexpr double kLargeScene = 1000, kLeastDetail = 100;

// The surface of the sun [W/m^2]: 5772 K, by Stefan and Boltzmann.
constexpr double kBrightest = 6.3e7;

bool Emits(const Scene& scene, const Patch& patch) {
  return (scene.materials[static_cast<std::size_t>(patch.material)].emittance > 0).any();
}

// Of lengths; skies, which emit, may be as far as they like.
void AddUnits(const Scene& scene, std::vector<std::string>* warnings) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double least = std::numeric_limits<double>::infinity();
  for (const Patch& patch : scene.patches) {
    least = std::min(least, Diameter(patch.Vertices()));
    if (Emits(scene, patch)) continue;
    for (const Vec3& v : patch.Vertices()) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  }
  const double thickness = (high - low).minCoeff(), diagonal = scene.Diagonal();
  if (thickness > kThickest || (diagonal > kLargeScene && least > kLeastDetail))
    warnings->push_back(fmt::format(
        "the scene is {:.3g} m across and its smallest face {:.3g} m: lengths are in metres; if these are "
        "millimetres, give --unit mm",
        diagonal, least));
  double brightest = 0;
  for (const Patch& patch : scene.patches)
    brightest =
        std::max(brightest, scene.materials[static_cast<std::size_t>(patch.material)].emittance.maxCoeff());
  if (brightest > kBrightest)
    warnings->push_back(fmt::format(
        "a surface emits {:.3g} W/m^2, more than that of the sun, {:.2g}: Ke is power per square metre, not "
        "the power of a lamp nor per square millimetre",
        brightest, kBrightest));
}

// Lamps shine down, and rooms are wider than high. If nearly all light leaves along another axis, from the
// end of the scene's shortest side, this axis is likely to point up in the file.
void AddUpAxis(const Scene& scene, std::vector<std::string>* warnings) {
  constexpr double kNearlyAll = 0.9, kShorter = 0.9, kAtTheTop = 0.75;
  const auto [low, high] = scene.Bounds();
  const Vec3 size = high - low;
  Vec3 down = Vec3::Zero();  // for each axis, the flux that leaves against the axis, from its end [W]
  double all = 0;
  for (const Patch& patch : scene.patches) {
    const double flux =
        patch.area * scene.materials[static_cast<std::size_t>(patch.material)].emittance.maxCoeff();
    all += flux;
    for (int axis = 0; axis < 3; ++axis)
      if (patch.normal[axis] < -kNearlyAll && patch.vertex[0][axis] > low[axis] + kAtTheTop * size[axis])
        down[axis] += flux;
  }
  if (all <= 0) return;
  for (const auto& [axis, name] : {std::pair(1, 'y'), std::pair(0, 'x')}) {
    const double others = std::min(size[2], size[1 - axis]);
    if (down[axis] >= kNearlyAll * all && size[axis] > 0 && size[axis] <= kShorter * others)
      warnings->push_back(
          fmt::format("nearly all light shines along -{0}, from the end of the shortest side: z is up here; "
                      "if {0} points "
                      "up in the file, give --up {0}",
                      name));
  }
}

void AddLight(const Scene& scene, std::vector<std::string>* warnings) {
  const auto emits = [&](const Patch& patch) { return Emits(scene, patch); };
  if (std::none_of(scene.patches.begin(), scene.patches.end(), emits)) {
    warnings->push_back(
        "nothing emits light, and all is dark; give a material of the library a Ke, or --emittance "
        "MATERIAL=r,g,b");
    return;
  }
  const std::size_t rays = std::clamp(kRays / scene.patches.size(), kFewestRays, kMostRays);
  const LitSides sides = FindLitSides(scene, rays);
  if (sides.TurnedInsideOut()) {
    warnings->push_back(
        fmt::format("{:.0f} % of the area that the light falls on is lit on its back, which is black; if "
                    "faces are reversed, "
                    "--flip turns every face, and --two-sided gives each a second one",
                    100 * sides.back / (sides.back + sides.front)));
    return;
  }
  const bool any_reflects = std::any_of(scene.patches.begin(), scene.patches.end(), [&](const Patch& patch) {
    return (scene.materials[static_cast<std::size_t>(patch.material)].reflectance > 0).any();
  });
  const std::vector<std::int32_t> dark = any_reflects ? DarkEmitters(scene) : std::vector<std::int32_t>();
  if (!dark.empty())
    warnings->push_back(fmt::format(
        "{} {} nothing, the first is face {} (counted from 0): before its front there is nothing, or only "
        "what "
        "turns its back",
        dark.size(), dark.size() == 1 ? "face that emits lights" : "faces that emit light", dark[0]));
}

}  // namespace

std::vector<std::string> SceneWarnings(const Scene& scene, bool lit) {
  std::vector<std::string> warnings;
  if (scene.patches.empty()) {
    warnings.push_back(scene.faces.empty()
                           ? "there is no face in the scene, and nothing to light"
                           : "no face with an area is left of the scene, and nothing to light");
    return warnings;
  }
  AddUnits(scene, &warnings);
  AddUpAxis(scene, &warnings);
  if (lit) AddLight(scene, &warnings);
  return warnings;
}

}  // namespace penumbra
