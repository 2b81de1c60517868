// tests/transport/manufactured.h
//
// Manufactured solutions: for a chosen radiosity, computes the emittance for which this radiosity solves the
// radiosity equation. Manufactured solutions test any solver in any scene with any blockers.

#pragma once

#include <functional>

#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_visibility.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// A chosen radiosity, smooth over each patch [W/m^2]. Called from several threads.
using RadiosityField = std::function<Rgb(PatchId patch, const Vec3& position)>;

// The irradiance from the field at a point on the front of a patch [W/m^2]. For fields that are smooth on the
// scale of a patch, exact with any blockers, except for kSourceQuadratureError.
Rgb FieldIrradiance(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                    PatchId patch, const ReceiverPoint& at);

// E = B - rho H at a point of a patch [W/m^2]: with this emittance everywhere, the field is the solution. May
// be negative, which is valid in an equation but not for a light.
Rgb ManufacturedEmittance(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                          PatchId patch, const Vec3& position);

// The scene with each patch cut into divisions x divisions tiles. Each tile is a patch and emits the mean of
// the manufactured emittance over the tile; tiles are in the order of their patches. As the tiles shrink, the
// radiosity of this scene converges to the field. REQUIRES: `divisions` is a power of two; the means are not
// negative.
Scene ManufacturedScene(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                        int divisions);

}  // namespace penumbra
