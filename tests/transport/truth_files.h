// tests/transport/truth_files.h
//
// Reads reference values with 12 to 30 digits from tests/truth, or from the folder that the environment
// variable PENUMBRA_TRUTH names.

#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "solver/scene/patch_builder.h"
#include "test_paths.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::truth {

using nlohmann::json;

// Returns the reference values in the file `name`. Throws std::runtime_error, so that the test fails, if the
// file of reference values is missing or contains no case.
inline json Load(const std::string& name) {
  const char* given = std::getenv("PENUMBRA_TRUTH");
  const std::filesystem::path path =
      (given ? std::filesystem::path(given)
             : std::filesystem::path(PENUMBRA_SOURCE_DIR) / "tests" / "truth") /
      name;
  std::ifstream file(path);
  if (!file) throw std::runtime_error("no reference values in " + path.string());
  json truth = json::parse(file);
  if (truth.at("cases").empty()) throw std::runtime_error("no cases in " + path.string());
  return truth;
}

inline Vec3 ToVec3(const json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }

inline Polygon3 ToPolygon(const json& j) {
  Polygon3 polygon;
  for (const json& v : j) polygon.push_back(ToVec3(v));
  return polygon;
}

inline double ToDouble(const json& j) { return std::stod(j.get<std::string>()); }

// Returns the scene of a test case that lists `faces` with a reflectance and an emittance each.
inline Scene FacesOf(const json& c) {
  Scene scene;
  scene.objects.resize(1);
  for (const json& face : c["faces"])
    scene.faces.push_back({ToPolygon(face["polygon"]),
                           scene_test::AddMaterial(scene, face["rho"].get<double>(), face["E"].get<double>()),
                           0});
  BuildPatches(scene);
  return scene;
}

// Returns the scene of a test case of radiosity_constant_basis.json or radiosity_continuous.json: a unit cube
// or a pair of unit squares.
inline Scene UnitScene(const json& c) {
  Scene scene;
  const json& rho = c["rho"];
  if (rho.is_object()) {
    const std::int32_t floor = scene_test::AddMaterial(scene, rho["floor"].get<double>(), 0),
                       ceiling = scene_test::AddMaterial(scene, rho["ceiling"].get<double>(), 1),
                       wall = scene_test::AddMaterial(scene, rho["walls"].get<double>(), 0);
    scene_test::AddBox(scene, Vec3::Zero(), Vec3::Ones(), true, {floor, ceiling, wall, wall, wall, wall});
    return scene;
  }
  for (int i : {0, 1}) scene_test::AddMaterial(scene, rho[i].get<double>(), c["E"][i].get<double>());
  scene_test::Add(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0);
  if (c["id"].get<std::string>().starts_with("perp"))
    scene_test::Add(scene, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, 1);
  else
    scene_test::Add(scene, {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, 1);
  return scene;
}

// Returns a point of a UnitScene(), given by the coordinates in radiosity_continuous.json: the patch on which
// the point lies, and its position.
inline std::pair<PatchId, Vec3> UnitPoint(const json& c, const std::string& surface, double a, double b) {
  if (surface == "floor") return {0, {a, b, 0}};
  if (surface == "ceiling") return {1, {a, b, 1}};
  if (surface == "wall") return {4, {0, a, b}};
  if (!c["id"].get<std::string>().starts_with("perp"))
    return surface == "square1" ? std::pair(0, Vec3(a, b, 0)) : std::pair(1, Vec3(a, b, 1));
  return surface == "square1" ? std::pair(0, Vec3(b, a, 0)) : std::pair(1, Vec3(0, a, b));
}

}  // namespace penumbra::truth
