#include "experiments/studies/reference_case.h"

#include <algorithm>
#include <cmath>

#include "solver/scene/builtin_scenes.h"
#include "solver/scene/obj_reader.h"

namespace penumbra {
namespace {

// A reference is taken for what it is within this many of its standard errors.
constexpr double kNoise = 2;
// Points lie on a patch within this share of the scene's diagonal, and normals within this cosine (1 degree).
constexpr double kOnPatch = 1e-6;
constexpr double kSameNormal = 0.9998;

}  // namespace

ReferenceCase LoadReferenceCase(const std::string& name) {
  if (std::optional<Scene> scene = LoadBuiltinScene(name, {}))
    return {name, *std::move(scene), ReadReference("reference/" + name + ".csv")};
  return {name, ReadObj("experiments/peers/" + name + ".obj", {}),
          ReadReference("peers/" + name + "_reference.csv")};
}

std::vector<double> ReferenceErrors(const ReferenceCase& test,
                                    const std::function<std::optional<Rgb>(const ReceiverPoint&)>& value) {
  Rgb mean = Rgb::Zero();
  for (const ReferencePoint& p : test.points) mean += p.irradiance / static_cast<double>(test.points.size());
  std::vector<double> errors;
  for (const ReferencePoint& p : test.points) {
    const std::optional<Rgb> found = value({p.position, p.normal, Vec3::Zero(), 0});
    if (!found) continue;
    const Rgb scale = p.irradiance.max(kDark * mean);
    for (int c = 0; c < 3; ++c) {
      const double off = std::abs((*found)[c] - p.irradiance[c]) - kNoise * p.deviation[c];
      errors.push_back(std::max(0.0, off) / scale[c]);
    }
  }
  return errors;
}

namespace {

struct ShownPlace {
  PatchId patch = kNoPatch;
  Rgb irradiance = Rgb::Zero();
};

std::optional<ShownPlace> PlaceBelow(const Pipeline& pipeline, const ReceiverPoint& at) {
  const Scene& scene = pipeline.scene();
  const double near = kOnPatch * scene.Diagonal();
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    const Patch& patch = scene.patches[i];
    if (patch.normal.dot(at.normal) < kSameNormal ||
        std::abs(patch.normal.dot(at.position - patch.vertex[0])) > near)
      continue;
    if (const std::optional<Rgb> shown = pipeline.Interpolated(static_cast<PatchId>(i), at.position, near))
      return ShownPlace{static_cast<PatchId>(i), *shown};
  }
  return std::nullopt;
}

}  // namespace

std::optional<PatchId> PatchBelow(const Pipeline& pipeline, const ReceiverPoint& at) {
  const std::optional<ShownPlace> place = PlaceBelow(pipeline, at);
  return place ? std::optional(place->patch) : std::nullopt;
}

std::optional<Rgb> ShownAt(const Pipeline& pipeline, const ReceiverPoint& at) {
  const std::optional<ShownPlace> place = PlaceBelow(pipeline, at);
  return place ? std::optional(place->irradiance) : std::nullopt;
}

PipelineOptions ThesisSettings() {
  PipelineOptions thesis;
  thesis.eps = 0.1;
  thesis.max_leaf_dsets = 10;
  thesis.min_discontinuity_weight = 100;
  thesis.max_corrections = 0;
  thesis.relative_cutoff = 1e-3;
  thesis.refine = RefineBy::kTransport;
  return thesis;
}

Measured MeasurePipeline(const ReferenceCase& test, const PipelineOptions& options, int repeats) {
  std::vector<double> seconds;
  std::unique_ptr<Pipeline> pipeline;
  for (int i = 0; i < repeats; ++i) {
    pipeline = std::make_unique<Pipeline>(test.scene, options);
    const double begin = ProcessorSeconds();
    pipeline->Solve({});
    pipeline->RefineLight({});
    pipeline->BuildMesh(MeshKind::kInterpolant, {});
    seconds.push_back(ProcessorSeconds() - begin);
  }
  std::sort(seconds.begin(), seconds.end());

  StudyRow row;
  row.scene = test.name;
  row.seconds = seconds[seconds.size() / 2];
  const PipelineReport::Counts& counts = pipeline->report().counts;
  row.elements = counts.elements;
  row.links = counts.links;
  row.triangles = counts.triangles;
  row.evaluations = counts.point_evaluations;
  SetErrors(ReferenceErrors(test, [&](const ReceiverPoint& at) { return ShownAt(*pipeline, at); }), &row);
  return {std::move(row), std::move(pipeline)};
}

}  // namespace penumbra
