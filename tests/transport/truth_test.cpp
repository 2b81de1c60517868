// Irradiance at points against reference values with 12 to 30 digits, where they are at hand: a folder
// `shared/truth` beside the checkout, or the one that PENUMBRA_TRUTH names.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "solver/scene/patch_builder.h"
#include "solver/scene/surface_points.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra {
namespace {

using nlohmann::json;

std::filesystem::path TruthFolder() {
  if (const char* folder = std::getenv("PENUMBRA_TRUTH")) return folder;
  return std::filesystem::path(PENUMBRA_SOURCE_DIR) / ".." / "shared" / "truth";
}

json Load(const std::string& name) {
  std::ifstream file(TruthFolder() / name);
  return file ? json::parse(file) : json();
}

Vec3 ToVec3(const json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }

Polygon3 ToPolygon(const json& j) {
  Polygon3 polygon;
  for (const json& v : j) polygon.push_back(ToVec3(v));
  return polygon;
}

// Adds a convex polygon as patches: triangles and quadrilaterals as they are, others as a fan.
void AddConvex(Scene& scene, const Polygon3& polygon, int material) {
  if (polygon.size() <= 4) {
    if (VectorArea(polygon).norm() > 0) scene.patches.push_back(MakePatch(polygon, material, 0, {}));
    return;
  }
  for (std::size_t i = 2; i < polygon.size(); ++i)
    AddConvex(scene, {polygon[0], polygon[i - 1], polygon[i]}, material);
}

Polygon3 FacingTowards(Polygon3 polygon, const Vec3& point) {
  const Vec3 area = VectorArea(polygon);
  if (area.dot(point - polygon[0]) < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

// True for polygons that a fan from the first vertex covers.
bool IsConvex(const Polygon3& polygon) {
  const Vec3 area = VectorArea(polygon);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()],
               &c = polygon[(i + 2) % polygon.size()];
    if ((b - a).cross(c - b).dot(area) < 0) return false;
  }
  return true;
}

// Every case of occluded.json with convex polygons, to the tolerance that it states.
TEST(Truth, OccludedLights) {
  const json truth = Load("occluded.json");
  if (truth.is_null()) GTEST_SKIP() << "no reference values beside the checkout";
  int tested = 0;
  double worst = 0;
  for (const json& c : truth["cases"]) {
    Scene scene;
    scene.materials.resize(1);
    const Vec3 point = ToVec3(c["point"]);
    bool convex = true;
    for (const json& light : c["lights"]) {
      const Polygon3 polygon = FacingTowards(ToPolygon(light["polygon"]), point);
      convex = convex && IsConvex(polygon);
      Material material;
      material.emittance = Rgb::Constant(light["M"].get<double>());
      scene.materials.push_back(material);
      AddConvex(scene, polygon, static_cast<int>(scene.materials.size()) - 1);
    }
    for (const json& occluder : c["occluders"]) {
      const Polygon3 polygon = ToPolygon(occluder);
      convex = convex && IsConvex(polygon);
      AddConvex(scene, polygon, 0);
    }
    if (!convex) continue;
    const SourceSet sources = SourceSet::Emitters(scene);
    const PatchVisibility visibility;
    const PointIrradiance irradiance(scene, visibility, sources);
    ReceiverPoint at;
    at.position = point;
    at.normal = ToVec3(c["normal"]).normalized();
    const double got = irradiance.Anywhere(at).irradiance[0], want = std::stod(c["E"].get<std::string>());
    const double allowed = std::max(c.value("atol", 0.0), c["rtol"].get<double>() * std::abs(want));
    EXPECT_LE(std::abs(got - want), allowed)
        << c["id"] << ": got " << got << ", want " << want << " (" << c["description"] << ")";
    worst = std::max(worst, std::abs(got - want) / std::max(allowed, 1e-300));
    ++tested;
  }
  std::printf("%d cases, worst error / tolerance %.3g\n", tested, worst);
  EXPECT_GT(tested, 50);
}

// Adds any polygon that shines towards the point, if it has an area.
void AddSource(Scene& scene, const Polygon3& polygon, const Vec3& point, bool two_sided) {
  if (VectorArea(polygon).norm() == 0) return;
  Scene one;
  one.materials = scene.materials;
  one.objects.resize(1);
  one.faces.push_back({two_sided ? FacingTowards(polygon, point) : polygon, 0, 0});
  if (IsConvex(one.faces[0].vertices)) {
    AddConvex(scene, one.faces[0].vertices, 0);
    return;
  }
  BuildPatches(one);
  scene.patches.insert(scene.patches.end(), one.patches.begin(), one.patches.end());
}

double ToDouble(const json& j) { return std::stod(j.get<std::string>()); }

// Every case of point_polygon.json, contact and concave ones too, to the tolerance that it states.
TEST(Truth, PointsAndPolygons) {
  const json truth = Load("point_polygon.json");
  if (truth.is_null()) GTEST_SKIP() << "no reference values beside the checkout";
  double worst = 0;
  for (const json& c : truth["cases"]) {
    Scene scene;
    scene_test::AddMaterial(scene, 0, 1);
    const Vec3 point = ToVec3(c["point"]);
    AddSource(scene, ToPolygon(c["polygon"]), point, !c.contains("emitter"));
    const ReceiverPoint at = scene_test::Receiver(point, ToVec3(c["normal"]));
    const double got = scene_test::Direct(scene, at).irradiance[0], want = ToDouble(c["F"]);
    const double allowed = std::max(c.value("atol", 0.0), c["rtol"].get<double>() * std::abs(want));
    EXPECT_LE(std::abs(got - want), allowed)
        << c["id"] << ": got " << got << ", want " << want << " (" << c["description"] << ")";
    worst = std::max(worst, std::abs(got - want) / allowed);
    if (!c.contains("limit_from_side")) continue;
    for (const double side : {1.0, -1.0}) {
      Scene towards;
      scene_test::AddMaterial(towards, 0, 1);
      AddSource(towards, ToPolygon(c["polygon"]), point + side * Vec3::UnitY(), true);
      const ReceiverPoint from = scene_test::Receiver(point, ToVec3(c["normal"]), Vec3(0.25, side, 0));
      EXPECT_NEAR(scene_test::Direct(towards, from).irradiance[0], ToDouble(c["limit_from_side"]), 1e-13)
          << c["id"] << " from side " << side;
    }
  }
  std::printf("%zu cases, worst error / tolerance %.3g\n", truth["cases"].size(), worst);
}

// The cases of lighting_analytic.json that are lights, occluders (or windows and masks) and points.
TEST(Truth, LightingAnalytic) {
  const json truth = Load("lighting_analytic.json");
  if (truth.is_null()) GTEST_SKIP() << "no reference values beside the checkout";
  int tested = 0;
  double worst = 0;
  for (const json& c : truth["cases"]) {
    // Masks beyond their window count whatever their depth: no scene of ours is like that.
    const bool window = c.contains("window") && c["masks"].empty();
    if (!c.contains("points") || (!c.contains("lights") && !window)) continue;
    for (const json& p : c["points"]) {
      Scene scene;
      scene_test::AddMaterial(scene, 0, 0);
      const Vec3 point = ToVec3(p["point"]);
      const auto add_light = [&](const Polygon3& polygon, double m) {
        AddConvex(scene, FacingTowards(polygon, point), scene_test::AddMaterial(scene, 0, m));
      };
      if (window) {
        // The sky shines above the point's horizon, the ground below it does not.
        const Polygon3 sky = ClipToHalfSpace(ToPolygon(c["window"]), Vec3::UnitZ(), point);
        if (!sky.empty()) add_light(sky, 1);
      } else {
        for (const json& light : c["lights"])
          add_light(ToPolygon(light["polygon"]), light["M"].get<double>());
        for (const json& occluder : c["occluders"]) AddConvex(scene, ToPolygon(occluder), 0);
      }
      const double got =
          scene_test::Direct(scene, scene_test::Receiver(point, ToVec3(p["normal"]))).irradiance[0];
      const double want = ToDouble(p["E"]), allowed = c["rtol"].get<double>() * std::abs(want);
      EXPECT_LE(std::abs(got - want), allowed)
          << c["id"] << " " << p["name"] << ": got " << got << ", want " << want;
      worst = std::max(worst, std::abs(got - want) / std::max(allowed, 1e-300));
      ++tested;
    }
  }
  std::printf("%d points, worst error / tolerance %.3g\n", tested, worst);
  EXPECT_GT(tested, 50);
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
  if (truth.is_null()) GTEST_SKIP() << "no reference values beside the checkout";
  int tested = 0;
  for (const json& c : truth["cases"]) {
    if (!c.contains("faces")) continue;
    Scene scene;
    scene.objects.resize(1);
    for (const json& face : c["faces"]) {
      const std::int32_t material =
          scene_test::AddMaterial(scene, face["rho"].get<double>(), face["E"].get<double>());
      scene.faces.push_back({ToPolygon(face["polygon"]), material, 0});
    }
    BuildPatches(scene);
    ExpectFurnace(scene, c["id"]);
    ++tested;
  }
  EXPECT_EQ(tested, 6);
}

// The closed cubes of radiosity_continuous.json, at points up to 2^-10 from the edges, where single elements
// count: within 5 %.
TEST(Truth, ContinuousCubes) {
  const json truth = Load("radiosity_continuous.json");
  if (truth.is_null()) GTEST_SKIP() << "no reference values beside the checkout";
  int tested = 0;
  for (const json& c : truth["cases"]) {
    if (!c["rho"].contains("ceiling")) continue;
    Scene scene;
    const json& rho = c["rho"];
    const std::int32_t floor = scene_test::AddMaterial(scene, rho["floor"].get<double>(), 0),
                       ceiling = scene_test::AddMaterial(scene, rho["ceiling"].get<double>(), 1),
                       wall = scene_test::AddMaterial(scene, rho["walls"].get<double>(), 0);
    scene_test::AddBox(scene, Vec3::Zero(), Vec3::Ones(), true, {floor, ceiling, wall, wall, wall, wall});
    const RadiositySolution solution = scene_test::Solved(scene, 0.02);
    const SourceSet sources = SourceSet::FromSolution(solution);
    const PatchVisibility visibility(scene);
    const PointIrradiance irradiance(scene, visibility, sources);
    double worst = 0;
    for (const auto& [name, points] : c["irradiance"].items())
      for (const json& p : points) {
        const double a = p["a"].get<double>(), b = p["b"].get<double>(), want = ToDouble(p["H"]);
        const PatchId patch = name == "floor" ? 0 : name == "ceiling" ? 1 : 4;
        const Vec3 at = patch == 0 ? Vec3(a, b, 0) : patch == 1 ? Vec3(a, b, 1) : Vec3(0, a, b);
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
