// mesh/refinement/emitter_light.h
//
// The light of one emitter alone: the emitter's part of the irradiance in a radiosity solution and in the
// solution's mesh. Light is linear in the emittance as long as elements, sources, form factors and the sample
// points of the mesh stay the same. The light of a scene is therefore the sum of the lights of its emitters.
// If emitters are dimmed, each emitter's light is multiplied by a factor before the sum.

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
  std::vector<PatchId> patches;  // the indices of the patches that form the emitter, in ascending order
  // The irradiance that arises from this emitter alone, including all reflections [W/m^2], of each element,
  // and of each fragment (convex piece of a leaf).
  std::vector<Rgb> element, fragment;
  std::vector<QuadraticInterpolant> interpolant;  // the emitter's light on each triangle of the mesh [W/m^2]
};

// Returns the sum of factor[k] * lights[k] over all k, added in ascending order of k. EmitterLight::patches
// of the sum is empty. REQUIRES: all lights have the same numbers of elements, fragments and triangles, and
// there is one factor for each light.
EmitterLight SumOf(std::span<const EmitterLight> lights, std::span<const Rgb> factor);

// Multiplies lights[k] by factor[k] for all k, and makes the sum of the lights the irradiance of the solution
// and of the mesh. The solution's radiosities are computed from the emittances of its scene, which the caller
// must have multiplied by the factors of the emitters.
void ScaleLights(std::span<const Rgb> factor, std::span<EmitterLight> lights, RadiositySolution& solution,
                 IrradianceMesh& mesh);

// The data of a light that a SourceSet needs: radiosities of elements and fragments, and emittances of
// patches.
struct SourceLight {
  // The radiosity of each quadtree element and of each fragment of a cut leaf [W/m^2].
  std::vector<Rgb> element, fragment;
  std::vector<Rgb> emittance;  // the emittance of each patch, from the emitters that are lit [W/m^2]

  SourceLight() = default;
  // Takes the light of a radiosity solution.
  explicit SourceLight(const RadiositySolution& solution);
  // Takes the light of one emitter of a radiosity solution.
  SourceLight(const RadiositySolution& solution, const EmitterLight& light);

  SourceSet::Light View() const { return {element, fragment, emittance}; }
};

}  // namespace penumbra
