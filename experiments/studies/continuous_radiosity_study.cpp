// The hierarchical solver against solutions of the continuous radiosity equation that are known to twelve
// digits: error against links and seconds.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiments/studies/study.h"
#include "solver/base/check.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/solvers/hierarchical_solver.h"

namespace penumbra {
namespace {

using nlohmann::json;

// The reference values: of tests/truth, for studies run from the root of the checkout, or of the folder that
// PENUMBRA_TRUTH names. Throws InputError if there are none.
json ReadTruth() {
  const char* given = std::getenv("PENUMBRA_TRUTH");
  const std::filesystem::path path =
      std::filesystem::path(given ? given : "tests/truth") / "radiosity_continuous.json";
  std::ifstream file(path);
  if (!file) throw InputError(path.string() + ":0: error: cannot be read; run the studies from the root");
  return json::parse(file);
}

struct Sample {
  PatchId patch;
  Vec3 position;
  double irradiance;
};

// Unit squares, each by a corner and the two sides that leave it, counter-clockwise from the front.
struct Square {
  Vec3 corner, first, second;
  double reflectance, emittance;
};

Scene MakeScene(const json& c, std::vector<Sample>* samples) {
  const Vec3 o = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const std::string id = c["id"];
  const json& rho = c["rho"];
  std::vector<Square> squares;
  std::map<std::string, std::size_t> named;
  if (rho.is_object()) {
    const double wall = rho["walls"];
    squares = {{o, x, y, rho["floor"], 0}, {z, y, x, rho["ceiling"], 1}, {o, y, z, wall, 0},
               {x, z, y, wall, 0},         {o, z, x, wall, 0},           {y, x, z, wall, 0}};
    named = {{"floor", 0}, {"ceiling", 1}, {"wall", 2}};
  } else {
    // Coordinates run along the common edge first.
    const bool perpendicular = id.starts_with("perp");
    squares = {{o, x, y, rho[0], c["E"][0]},
               perpendicular ? Square{o, y, z, rho[1], c["E"][1]} : Square{z, y, x, rho[1], c["E"][1]}};
    named = {{"square1", 0}, {"square2", 1}};
  }
  Scene scene;
  scene.name = id;
  for (const Square& s : squares) {
    Material material;
    material.reflectance = Rgb::Constant(s.reflectance);
    material.emittance = Rgb::Constant(s.emittance);
    const auto index = static_cast<std::int32_t>(scene.materials.size());
    scene.materials.push_back(material);
    const std::array<Vec3, 4> corners = {s.corner, s.corner + s.first, s.corner + s.first + s.second,
                                         s.corner + s.second};
    scene.patches.push_back(MakePatch(corners, index, 0, {index}));
  }
  for (const auto& [name, points] : c["irradiance"].items())
    for (const json& p : points) {
      const Vec2 at(p["a"].get<double>(), p["b"].get<double>());
      const auto patch = static_cast<PatchId>(named.at(name));
      Vec3 position;
      if (name == "wall" || (name == "square2" && id.starts_with("perp")))
        position = {0, at.x(), at.y()};
      else if (name == "square1" && id.starts_with("perp"))
        position = {at.y(), at.x(), 0};
      else
        position = {at.x(), at.y(), patch == 0 ? 0.0 : 1.0};
      samples->push_back({patch, position, std::stod(p["H"].get<std::string>())});
    }
  return scene;
}

// Whether the last step is not exact enough, and the next one not too dear.
bool GoesOn(const StudyLog& log) {
  constexpr double kExact = 1e-4;
  constexpr double kDearer = 4, kMostSeconds = 150;  // of processors
  const StudyRow& last = log.rows().back();
  return !log.quick() && last.error_max > kExact && kDearer * last.seconds < kMostSeconds;
}

void StudyContinuousRadiosity(StudyLog& log) {
  const json truth = ReadTruth();
  for (const json& c : truth["cases"]) {
    std::vector<Sample> samples;
    const Scene scene = MakeScene(c, &samples);
    const PatchVisibility visibility(scene);
    std::vector<double> links, sources, seconds, errors;
    // Links carry the light well enough for a pass of correction to gain a digit; what the sources' parts may
    // err by is what is left.
    for (double error = 0.02; error > (log.quick() ? 4e-3 : 1e-4) || GoesOn(log); error /= 2) {
      SolverOptions options;
      options.eps = 0.4 * std::sqrt(error);
      options.min_area = 1e-7;
      options.relative_cutoff = 0.01 * error;
      options.source_error = error;
      const double begin = ProcessorSeconds();
      HierarchicalSolver solver(scene, visibility, options);
      solver.Solve({});
      StudyRow row;
      row.seconds = ProcessorSeconds() - begin;
      const PointIrradiance exact(solver.solution(), visibility);
      std::vector<double> off;
      for (const Sample& sample : samples) {
        ReceiverPoint at;
        at.position = sample.position;
        at.normal = scene.patches[sample.patch].normal;
        off.push_back(std::abs(exact.OnPatch(sample.patch, at).irradiance[0] / sample.irradiance - 1));
      }
      row.scene = scene.name;
      row.method = scene.name;
      row.setting = fmt::format("source error {:.3g}", error);
      row.parameter = error;
      row.elements = exact.sources().LeafRadiosities().size();
      row.links = solver.solution().links.links.size();
      SetErrors(off, &row);
      links.push_back(static_cast<double>(*row.links));
      sources.push_back(static_cast<double>(*row.elements));
      seconds.push_back(row.seconds);
      errors.push_back(row.error_rms);
      log.Add(std::move(row));
    }
    log.Find(fmt::format(
        "{}: the rms error falls from {:.2g} to {:.2g}, as sources^{:.2f}, links^{:.2f} and seconds^{:.2f}.",
        scene.name, errors.front(), errors.back(), LogSlope(sources, errors), LogSlope(links, errors),
        LogSlope(seconds, errors)));
  }
}

}  // namespace

extern const Study kContinuousRadiosityStudy;
const Study kContinuousRadiosityStudy = {
    "continuous-radiosity",
    "The hierarchical solver and exact probes against the continuous "
    "radiosity equation; relative error of the "
    "irradiance at points down to 2^-10 from an edge; seconds of processors",
    "Where walls meet radiosity goes as d^0.763 from the edge. With "
    "sources cut by lines along the edge, at halves of the distance, the "
    "error falls with the tolerance nonetheless. (Elements: leaves and "
    "their parts.)",
    "seconds",
    "error_rms",
    StudyContinuousRadiosity};

}  // namespace penumbra
