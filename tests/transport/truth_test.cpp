// Irradiance at points against reference values with 12 to 30 digits.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>

#include "solver/scene/patch_builder.h"
#include "solver/scene/surface_points.h"
#include "solver/visibility/area/area_form_factor.h"
#include "solver/visibility/point/form_factor.h"
#include "tests/transport/transport_test_tools.h"
#include "tests/transport/truth_files.h"

namespace penumbra {
namespace {

using namespace truth;

Polygon3 FacingTowards(Polygon3 polygon, const Vec3& point) {
  const Vec3 area = VectorArea(polygon);
  if (area.dot(point - polygon[0]) < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

// Adds any polygon, concave too, as patches, if it has an area.
void AddPolygon(Scene& scene, const Polygon3& polygon, std::int32_t material) {
  if (VectorArea(polygon).norm() == 0) return;
  Scene one;
  one.materials = scene.materials;
  one.objects.resize(1);
  one.faces.push_back({polygon, material, 0});
  BuildPatches(one);
  scene.patches.insert(scene.patches.end(), one.patches.begin(), one.patches.end());
}

// The reference values travel with the code, whole; a test that asks for a file that is not there fails.
TEST(Truth, IsThere) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(PENUMBRA_SOURCE_DIR) / "tests" / "truth")) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path());
    const json truth = json::parse(file);
    EXPECT_EQ(truth["cases"].size(), truth["count"].get<std::size_t>()) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 7U);
  EXPECT_THROW(Load("no_such_file.json"), std::runtime_error);
}

// Every case of occluded.json, by every exact method, to the tolerance that it states.
TEST(Truth, OccludedLights) {
  const json truth = Load("occluded.json");
  for (const auto& [name, method] : scene_test::ExactMethods()) {
    double worst = 0;
    for (const json& c : truth["cases"]) {
      Scene scene;
      scene_test::AddMaterial(scene, 0, 0);
      const Vec3 point = ToVec3(c["point"]);
      for (const json& light : c["lights"])
        AddPolygon(scene, FacingTowards(ToPolygon(light["polygon"]), point),
                   scene_test::AddMaterial(scene, 0, light["M"].get<double>()));
      for (const json& occluder : c["occluders"]) AddPolygon(scene, ToPolygon(occluder), 0);
      const ReceiverPoint at = scene_test::Receiver(point, ToVec3(c["normal"]));
      const double got = scene_test::Direct(scene, at, method.get()).irradiance[0], want = ToDouble(c["E"]);
      const double allowed = std::max(c.value("atol", 0.0), c["rtol"].get<double>() * std::abs(want));
      EXPECT_LE(std::abs(got - want), allowed) << name << ", " << c["id"] << ": got " << got << ", want "
                                               << want << " (" << c["description"] << ")";
      worst = std::max(worst, std::abs(got - want) / std::max(allowed, 1e-300));
    }
    std::printf("%s: %zu cases, worst error / tolerance %.3g\n", name.c_str(), truth["cases"].size(), worst);
  }
}

// Every case of point_polygon.json, contact and concave ones too, by every exact method, to the tolerance
// that it states.
TEST(Truth, PointsAndPolygons) {
  const json truth = Load("point_polygon.json");
  for (const auto& [name, method] : scene_test::ExactMethods()) {
    double worst = 0;
    for (const json& c : truth["cases"]) {
      Scene scene;
      const std::int32_t light = scene_test::AddMaterial(scene, 0, 1);
      const Vec3 point = ToVec3(c["point"]);
      const Polygon3 polygon = ToPolygon(c["polygon"]);
      AddPolygon(scene, c.contains("emitter") ? polygon : FacingTowards(polygon, point), light);
      const ReceiverPoint at = scene_test::Receiver(point, ToVec3(c["normal"]));
      const double got = scene_test::Direct(scene, at, method.get()).irradiance[0], want = ToDouble(c["F"]);
      const double allowed = std::max(c.value("atol", 0.0), c["rtol"].get<double>() * std::abs(want));
      EXPECT_LE(std::abs(got - want), allowed) << name << ", " << c["id"] << ": got " << got << ", want "
                                               << want << " (" << c["description"] << ")";
      worst = std::max(worst, std::abs(got - want) / allowed);
      if (!c.contains("limit_from_side")) continue;
      for (const double side : {1.0, -1.0}) {
        Scene towards;
        scene_test::AddMaterial(towards, 0, 1);
        AddPolygon(towards, FacingTowards(polygon, point + side * Vec3::UnitY()), 0);
        const ReceiverPoint from = scene_test::Receiver(point, ToVec3(c["normal"]), Vec3(0.25, side, 0));
        EXPECT_NEAR(scene_test::Direct(towards, from, method.get()).irradiance[0],
                    ToDouble(c["limit_from_side"]), 1e-13)
            << c["id"] << " from side " << side;
      }
    }
    std::printf("%s: %zu cases, worst error / tolerance %.3g\n", name.c_str(), truth["cases"].size(), worst);
  }
}

// What a point sees of the sky through a window past masks, whatever their depth: their shadows are cut out
// of the window. No scene is like that, but the methods can be asked.
double MaskedSky(const json& c, const ReceiverPoint& at, const OcclusionMethod& method) {
  // The sky shines above the point's horizon, the ground below it does not.
  const Polygon3 sky =
      ClipToHalfSpace(FacingTowards(ToPolygon(c["window"]), at.position), Vec3::UnitZ(), at.position);
  if (sky.empty()) return 0;
  std::vector<Cone> cones;
  for (const json& mask : c["masks"]) {
    const Polygon3 polygon = FacingTowards(ToPolygon(mask), at.position);
    cones.push_back(MakeCone(at, Seen(at, polygon, true), 24));
  }
  const std::vector<Occluder> occluders(cones.begin(), cones.end());
  return method.VisibleFormFactor(ClipToHorizon(at, Seen(at, sky, true), 24), occluders, at.normal);
}

// All points of lighting_analytic.json, to the 1e-12 that it states.
TEST(Truth, LightingAnalytic) {
  const json truth = Load("lighting_analytic.json");
  for (const auto& [name, method] : scene_test::ExactMethods()) {
    int tested = 0;
    double worst = 0;
    for (const json& c : truth["cases"]) {
      if (!c.contains("points")) continue;
      for (const json& p : c["points"]) {
        const Vec3 point = ToVec3(p["point"]);
        const ReceiverPoint at = scene_test::Receiver(point, ToVec3(p["normal"]));
        double got = 0;
        if (c.contains("window")) {
          got = MaskedSky(c, at, method ? *method : FastestExactMethod());
        } else {
          Scene scene;
          scene_test::AddMaterial(scene, 0, 0);
          for (const json& light : c["lights"])
            AddPolygon(scene, FacingTowards(ToPolygon(light["polygon"]), point),
                       scene_test::AddMaterial(scene, 0, light["M"].get<double>()));
          for (const json& occluder : c["occluders"]) AddPolygon(scene, ToPolygon(occluder), 0);
          got = scene_test::Direct(scene, at, method.get()).irradiance[0];
        }
        const double want = ToDouble(p["E"]), allowed = c["rtol"].get<double>() * std::abs(want);
        EXPECT_LE(std::abs(got - want), allowed)
            << name << ", " << c["id"] << " " << p["name"] << ": got " << got << ", want " << want;
        worst = std::max(worst, std::abs(got - want) / std::max(allowed, 1e-300));
        ++tested;
      }
    }
    std::printf("%s: %d points, worst error / tolerance %.3g\n", name.c_str(), tested, worst);
    EXPECT_GT(tested, 100);
  }
}

// Every case of area_area.json, either way, to the tolerance that it states; and the error is what it says.
TEST(Truth, AreasAndAreas) {
  const json truth = Load("area_area.json");
  double worst = 0, worst_stated = 0, slowest = 0;
  for (const json& c : truth["cases"]) {
    Scene scene;
    scene_test::AddMaterial(scene, 0, 0);
    std::vector<std::size_t> ends = {0};
    const Polygon3 first = ToPolygon(c["polygon1"]), second = ToPolygon(c["polygon2"]);
    AddPolygon(scene, FacingTowards(first, Centroid(second)), 0);
    ends.push_back(scene.patches.size());
    AddPolygon(scene, FacingTowards(second, Centroid(first)), 0);
    ends.push_back(scene.patches.size());
    for (const json& occluder : c["occluders"]) AddPolygon(scene, ToPolygon(occluder), 0);
    const auto parts = [&](std::size_t polygon) {
      std::vector<AreaPart> of;
      for (std::size_t p = ends[polygon]; p < ends[polygon + 1]; ++p)
        of.push_back({static_cast<PatchId>(p),
                      {scene.patches[p].Vertices().begin(), scene.patches[p].Vertices().end()}});
      return of;
    };
    for (const bool there : {true, false}) {
      const auto begin = std::chrono::steady_clock::now();
      const FormFactorEstimate got = AreaFormFactor(scene, parts(there ? 0 : 1), parts(there ? 1 : 0));
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      const double want = ToDouble(c[there ? "F12" : "F21"]), off = std::abs(got.factor - want);
      const double allowed = c["rtol"].get<double>() * want;
      const std::string name = c["id"].get<std::string>() + (there ? " F12" : " F21");
      EXPECT_LE(off, allowed) << name << ": got " << got.factor << ", want " << want;
      EXPECT_LE(off, got.error) << name << ": stated " << got.error;
      EXPECT_LE(got.error, std::max(allowed, 1e-12 * want)) << name << " states more than is allowed";
      if (std::getenv("PENUMBRA_VERBOSE"))
        std::printf("%s: off %.2g of %.2g allowed, stated %.2g, %.3f s\n", name.c_str(), off, allowed,
                    got.error, seconds);
      worst = std::max(worst, off / std::max(allowed, 1e-300));
      worst_stated = std::max(worst_stated, off / std::max(got.error, 1e-300));
      slowest = std::max(slowest, seconds);
    }
  }
  std::printf("%zu cases, worst error / tolerance %.3g, worst error / stated error %.3g, slowest %.2f s\n",
              truth["cases"].size(), worst, worst_stated, slowest);
}

// Nodes and weights of Gauss and Legendre's rule on [0, 1], by Newton's method.
std::vector<std::pair<double, double>> GaussRule(int n) {
  std::vector<std::pair<double, double>> rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 20; ++step) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    rule.emplace_back(0.5 * (1 + x), 1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

// The flux that a light in the ceiling of a room 4 x 4 x 3 sends to the floor and to each wall: the mean over
// the light of the points' form factors, in closed form, and 1 in all.
void ExpectFlux(const json& expected, double x0, double x1, double y0, double y1) {
  const std::map<std::string, Polygon3> targets = {{"floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}},
                                                   {"wall_x0", {{0, 0, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 3}}},
                                                   {"wall_x4", {{4, 0, 0}, {4, 0, 3}, {4, 4, 3}, {4, 4, 0}}},
                                                   {"wall_y0", {{0, 0, 0}, {0, 0, 3}, {4, 0, 3}, {4, 0, 0}}},
                                                   {"wall_y4", {{0, 4, 0}, {4, 4, 0}, {4, 4, 3}, {0, 4, 3}}}};
  double sum = 0;
  for (const auto& [name, polygon] : targets) {
    double flux = 0;
    for (const auto& [s, ws] : GaussRule(32))
      for (const auto& [t, wt] : GaussRule(32)) {
        const ReceiverPoint at =
            scene_test::Receiver({x0 + s * (x1 - x0), y0 + t * (y1 - y0), 3}, {0, 0, -1});
        flux += ws * wt * FormFactor(ClipToHorizon(at, Seen(at, polygon, true), 4), at.normal);
      }
    const double want = ToDouble(expected.contains(name) ? expected[name] : expected["each_wall"]);
    EXPECT_NEAR(flux, want, 1e-12) << name;
    sum += flux;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(Truth, FluxIsConserved) {
  const json truth = Load("lighting_analytic.json");
  int tested = 0;
  for (const json& c : truth["cases"]) {
    if (c["id"] == "flux_conservation") ++tested, ExpectFlux(c["expected"], 1.5, 2.5, 1.5, 2.5);
    if (c["id"] == "flux_conservation_offcentre") ++tested, ExpectFlux(c["expected"], 1, 1.5, 0.5, 2);
  }
  EXPECT_EQ(tested, 2);
}

// The solver is asked for links that err by at most 10 % of the radiosity over an element of 1/256 of the
// scene. Errors of elements then average out to some 1e-3 of bias a reflection, and are off by some percent
// beside corners, where elements keep their parents' form factors.
void ExpectFurnace(const Scene& scene, const std::string& id) {
  const RadiositySolution solution = scene_test::Solved(scene, 0.1);
  const SourceSet sources = SourceSet::FromSolution(solution);
  const PatchVisibility visibility(scene);
  const PointIrradiance irradiance(scene, visibility, sources);
  constexpr std::size_t kPoints = 200;
  double sum = 0, square = 0, worst = 0;
  for (const SurfacePoint& p : SpreadPoints(scene, kPoints, 5)) {
    const ReceiverPoint at = scene_test::Receiver(p.position, scene.patches[p.patch].normal);
    const double error = irradiance.OnPatch(p.patch, at).irradiance[0] - 1;
    sum += error;
    square += error * error;
    worst = std::max(worst, std::abs(error));
  }
  const double mean = sum / kPoints, rms = std::sqrt(square / kPoints);
  std::printf("%s: irradiance off by %.2g on the whole, rms %.2g, at worst %.2g; %zu links\n", id.c_str(),
              mean, rms, worst, solution.links.links.size());
  double reflectance = 0;
  for (const Material& material : scene.materials)
    reflectance = std::max(reflectance, material.reflectance.maxCoeff());
  EXPECT_LE(std::abs(mean), 2e-3 / (1 - reflectance)) << id;
  EXPECT_LE(rms, 0.04) << id;
  EXPECT_LE(worst, 0.15) << id;
}

// The closed boxes of radiosity_exact.json, whose radiosity and irradiance are 1 everywhere.
TEST(Truth, Furnaces) {
  const json truth = Load("radiosity_exact.json");
  int tested = 0;
  for (const json& c : truth["cases"]) {
    if (!c.contains("faces")) continue;
    ExpectFurnace(FacesOf(c), c["id"]);
    ++tested;
  }
  EXPECT_EQ(tested, 6);
}

// The closed cubes of radiosity_continuous.json, at points up to 2^-10 from the edges, where single elements
// count: within 5 %.
TEST(Truth, ContinuousCubes) {
  const json truth = Load("radiosity_continuous.json");
  int tested = 0;
  for (const json& c : truth["cases"]) {
    if (!c["rho"].contains("ceiling")) continue;
    const Scene scene = UnitScene(c);
    const RadiositySolution solution = scene_test::Solved(scene, 0.02);
    const SourceSet sources = SourceSet::FromSolution(solution);
    const PatchVisibility visibility(scene);
    const PointIrradiance irradiance(scene, visibility, sources);
    double worst = 0;
    for (const auto& [name, points] : c["irradiance"].items())
      for (const json& p : points) {
        const double a = p["a"].get<double>(), b = p["b"].get<double>(), want = ToDouble(p["H"]);
        const auto [patch, at] = UnitPoint(c, name, a, b);
        const double got =
            irradiance.OnPatch(patch, scene_test::Receiver(at, scene.patches[patch].normal)).irradiance[0];
        EXPECT_NEAR(got, want, 0.05 * want) << c["id"] << " " << name << " " << p["name"];
        worst = std::max(worst, std::abs(got - want) / want);
      }
    std::printf("%s: worst relative error %.2g, %zu links\n", c["id"].get<std::string>().c_str(), worst,
                solution.links.links.size());
    ++tested;
  }
  EXPECT_EQ(tested, 2);
}

}  // namespace
}  // namespace penumbra
