// mesh/pipeline/solution_check.h
//
// Whether what was read from a solution file makes sense: every index in its range, every number finite,
// every tree a tree. Nothing that the stages take for granted is taken for granted of a file.

#pragma once

#include <span>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/solution.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// All throw Hdf5Error with what is wrong.

void CheckScene(const Scene& scene);
void CheckVisibility(const Scene& scene, const PatchVisibility::Rows& rows);
// The forest with just these elements: subdividing the roots gives them back.
ElementForest RestoreForest(const Scene& scene, std::span<const Element> elements);
void CheckLight(const RadiositySolution& solution);
void CheckMesh(const Scene& scene, const IrradianceMesh& mesh);

}  // namespace penumbra
