// mesh/pipeline/solution_check.h
//
// Checks of data from a solution file: all indices are in range, all numbers are finite, and the references
// between parent and child elements form trees. The checks of a solution file cover every property on which
// the stages of the pipeline rely.

#pragma once

#include <span>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/refinement/emitter_light.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/solution.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// All functions throw Hdf5Error with a description of the fault if a check fails.

void CheckScene(const Scene& scene);
void CheckVisibility(const Scene& scene, const PatchVisibility::Rows& rows);
// Makes a forest of quadtrees by subdividing the roots, such that its elements are exactly `elements`.
ElementForest RestoreForest(const Scene& scene, std::span<const Element> elements);
void CheckLight(const RadiositySolution& solution);
void CheckMesh(const Scene& scene, const IrradianceMesh& mesh);
void CheckEmitters(const RadiositySolution& solution, const IrradianceMesh& mesh,
                   std::span<const EmitterLight> emitters);

}  // namespace penumbra
