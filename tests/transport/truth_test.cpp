// Irradiance at points against reference values with 12 to 30 digits, where they are at hand: a folder
// `shared/truth` beside the checkout, or the one that PENUMBRA_TRUTH names.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "solver/transport/point_irradiance.h"

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

}  // namespace
}  // namespace penumbra
