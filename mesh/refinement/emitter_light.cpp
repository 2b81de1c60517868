#include "mesh/refinement/emitter_light.h"

#include <cstddef>

#include "solver/base/check.h"
#include "solver/transport/links/push_pull.h"

namespace penumbra {
namespace {

void AddTo(std::vector<Rgb>& sum, const Rgb& factor, const std::vector<Rgb>& light) {
  sum.resize(light.size(), Rgb::Zero());
  for (std::size_t i = 0; i < light.size(); ++i) sum[i] += factor * light[i];
}

QuadraticInterpolant Scaled(const QuadraticInterpolant& q, const Rgb& factor) {
  return {factor * q.a, factor * q.b2, factor * q.c2, factor * q.d, factor * q.e2, factor * q.f};
}

void AddTo(std::vector<QuadraticInterpolant>& sum, const Rgb& factor,
           const std::vector<QuadraticInterpolant>& light) {
  sum.resize(light.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const QuadraticInterpolant q = Scaled(light[i], factor);
    sum[i] = {sum[i].a + q.a, sum[i].b2 + q.b2, sum[i].c2 + q.c2,
              sum[i].d + q.d, sum[i].e2 + q.e2, sum[i].f + q.f};
  }
}

}  // namespace

EmitterLight SumOf(std::span<const EmitterLight> lights, std::span<const Rgb> factor) {
  PENUMBRA_CHECK(lights.size() == factor.size());
  EmitterLight sum;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    PENUMBRA_CHECK(lights[k].element.size() == lights[0].element.size() &&
                   lights[k].fragment.size() == lights[0].fragment.size() &&
                   lights[k].interpolant.size() == lights[0].interpolant.size());
    AddTo(sum.element, factor[k], lights[k].element);
    AddTo(sum.fragment, factor[k], lights[k].fragment);
    AddTo(sum.interpolant, factor[k], lights[k].interpolant);
  }
  return sum;
}

void ScaleLights(std::span<const Rgb> factor, std::span<EmitterLight> lights, RadiositySolution& solution,
                 IrradianceMesh& mesh) {
  const EmitterLight sum = SumOf(lights, factor);
  if (!lights.empty()) {
    ReplaceIrradiance(sum.element, sum.fragment, solution);
    mesh.irradiance = sum.interpolant;
  }
  for (std::size_t k = 0; k < lights.size(); ++k) {
    for (auto* values : {&lights[k].element, &lights[k].fragment})
      for (Rgb& value : *values) value *= factor[k];
    for (QuadraticInterpolant& q : lights[k].interpolant) q = Scaled(q, factor[k]);
  }
}

SourceLight::SourceLight(const RadiositySolution& solution) : element(solution.radiosity) {
  for (const Fragment& piece : solution.fragments) fragment.push_back(piece.radiosity);
  const Scene& scene = solution.forest.scene();
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    emittance.push_back(scene.MaterialOf(static_cast<PatchId>(p)).emittance);
}

SourceLight::SourceLight(const RadiositySolution& solution, const EmitterLight& light)
    : emittance(solution.forest.scene().patches.size(), Rgb::Zero()) {
  const Scene& scene = solution.forest.scene();
  for (const PatchId patch : light.patches)
    emittance[static_cast<std::size_t>(patch)] = scene.MaterialOf(patch).emittance;
  const auto radiosity = [&](ElementId of, const Rgb& irradiance) {
    const PatchId patch = solution.forest[of].patch;
    return Rgb(emittance[static_cast<std::size_t>(patch)] + scene.MaterialOf(patch).reflectance * irradiance);
  };
  for (std::size_t e = 0; e < light.element.size(); ++e)
    element.push_back(radiosity(static_cast<ElementId>(e), light.element[e]));
  for (std::size_t i = 0; i < light.fragment.size(); ++i)
    fragment.push_back(radiosity(solution.fragments[i].leaf, light.fragment[i]));
}

}  // namespace penumbra
