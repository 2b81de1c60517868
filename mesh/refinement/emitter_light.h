// mesh/refinement/emitter_light.h
//
// The light of one emitter alone, on everything on which a solution and its mesh hold the whole light. Light
// is linear in the emittance as long as elements, sources, form factors and the nodes of the mesh stay the
// same. The whole light is therefore the sum of the lights of all emitters, and a dimmed scene has the sum
// with a factor for each.

#pragma once

#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/quadratic_interpolant.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/sources/source_set.h"

namespace penumbra {

struct EmitterLight {
  std::vector<PatchId> patches;  // that the emitter consists of, ascending
  // The irradiance that arises from this emitter alone, with all its reflections [W/m^2]: of each element,
  // and of each fragment of the solution.
  std::vector<Rgb> element, fragment;
  std::vector<QuadraticInterpolant> interpolant;  // of each triangle of the mesh [W/m^2]
};

// The sum over all lights of factor[k] * lights[k], in the order of the lights; `patches` is empty. REQUIRES:
// all lights have as many elements, fragments and triangles; there is one factor for each light.
EmitterLight SumOf(std::span<const EmitterLight> lights, std::span<const Rgb> factor);

// Multiplies the lights by factors, and gives their sum to the solution and the mesh. The radiosities follow
// from the emittances of the solution's scene, which must be multiplied by the same factors.
void ScaleLights(std::span<const Rgb> factor, std::span<EmitterLight> lights, RadiositySolution& solution,
                 IrradianceMesh& mesh);

// What a source set needs of a light: radiosities of elements and fragments, and emittances.
struct SourceLight {
  std::vector<Rgb> element, fragment, emittance;  // [W/m^2]

  SourceLight() = default;
  // The light of a solution.
  explicit SourceLight(const RadiositySolution& solution);
  // The light of one emitter of a solution.
  SourceLight(const RadiositySolution& solution, const EmitterLight& light);

  SourceSet::Light View() const { return {element, fragment, emittance}; }
};

}  // namespace penumbra
