// Form factors between elements: the disk, the mean over points, random rays, and exact integration
// (thesis 4.2).

#include <cmath>

#include <fmt/format.h>

#include "experiments/bench/bench_scenes.h"
#include "experiments/studies/study.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/approximate_form_factor.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {
namespace {

// Two unit squares that face each other `distance` apart, or, with distance 0, stand at right angles with a
// common edge; a board of half their width midway hides a part, if asked for.
Scene Pair(double distance, bool occluded) {
  Scene scene;
  scene.materials = GreyAndLight();
  AddPatch(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0);
  if (distance > 0) {
    AddPatch(scene, {{0, 0, distance}, {0, 1, distance}, {1, 1, distance}, {1, 0, distance}}, 0);
    const double z = distance / 2;
    if (occluded) AddPatch(scene, {{0.25, 0.25, z}, {0.75, 0.25, z}, {0.75, 0.75, z}, {0.25, 0.75, z}}, 0);
  } else {
    AddPatch(scene, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, 0);
    if (occluded)
      AddPatch(scene, {{0.25, 0.25, 0.5}, {0.25, 0.75, 0.5}, {0.5, 0.75, 0.25}, {0.5, 0.25, 0.25}}, 0);
  }
  for (Patch& patch : scene.patches) {
    Face face;
    face.vertices.assign(patch.Vertices().begin(), patch.Vertices().end());
    scene.faces.push_back(std::move(face));
  }
  return scene;
}

void StudyFormFactors(StudyLog& log) {
  const double at_least = log.quick() ? 0.001 : 0.1;
  struct Worst {
    std::string scene;
    double error = 0;
  };
  Worst disk, cubature;
  for (const bool occluded : {false, true})
    for (const double distance :
         log.quick() ? std::vector<double>{1} : std::vector<double>{0, 0.1, 0.3, 1, 3, 10, 100}) {
      const Scene scene = Pair(distance, occluded);
      const AreaPart from{0, {scene.patches[0].Vertices().begin(), scene.patches[0].Vertices().end()}},
          to{1, {scene.patches[1].Vertices().begin(), scene.patches[1].Vertices().end()}};
      const std::span<const AreaPart> sends(&from, 1), receives(&to, 1);
      AreaFormFactorOptions exact;
      exact.tolerance = log.quick() ? 1e-4 : 1e-8;
      const double truth = AreaFormFactor(scene, sends, receives, exact).factor;
      const std::string name =
          fmt::format("{}{}", distance > 0 ? fmt::format("distance {:g}", distance) : "common edge",
                      occluded ? ", a board between" : "");
      const auto measure = [&](const std::string& method, const std::string& setting, auto&& estimate) {
        FormFactorEstimate found;
        StudyRow row;
        row.scene = name;
        row.method = method;
        row.setting = setting;
        row.parameter = distance;
        row.seconds = SecondsPerCall(at_least, [&] { found = estimate(); });
        SetErrors({std::abs(found.factor / truth - 1)}, &row);
        const double error = row.error_max;
        log.Add(std::move(row));
        return error;
      };
      const auto keep = [&](Worst& worst, double error) {
        if (error > worst.error) worst = {name, error};
      };
      keep(disk, measure("disk", "centroids", [&] { return DiskFormFactor(scene, sends, receives); }));
      keep(cubature,
           measure("cubature", "16 parts", [&] { return CubatureFormFactor(scene, sends, receives); }));
      for (const std::size_t rays :
           log.quick() ? std::vector<std::size_t>{1000} : std::vector<std::size_t>{1000, 100'000})
        measure("malley", fmt::format("{} rays", rays), [&] {
          LinkFormFactorOptions options;
          options.rays = rays;
          return LinkFormFactorMethods().Make("malley", options)->Between(scene, sends, receives, {}).value();
        });
      for (const double tolerance :
           log.quick() ? std::vector<double>{1e-2} : std::vector<double>{1e-2, 1e-4, 1e-6}) {
        AreaFormFactorOptions options;
        options.tolerance = options.clear_tolerance = tolerance;
        measure("exact", fmt::format("tolerance {:g}", tolerance),
                [&] { return AreaFormFactor(scene, sends, receives, options); });
      }
    }
  log.Find(
      fmt::format("The disk approximation is at worst {:.3g} of the form factor off ({}); the mean over "
                  "points {:.3g} ({}).",
                  disk.error, disk.scene, cubature.error, cubature.scene));
}

}  // namespace

extern const Study kFormFactorStudy;
const Study kFormFactorStudy = {
    "form-factors",
    "Form factors between two squares, near, far and past a board, by method; relative errors",
    "Of three ways to an element's form factor only the mean over points of the receiver is right near and "
    "far; the others "
    "can be an order of magnitude off (Hardt 1996, 4.2).",
    "seconds",
    "error_max",
    StudyFormFactors};

}  // namespace penumbra
