// tests/transport/manufactured.h
//
// Manufactured solutions: choose a radiosity, and derive the emittance that makes it the solution of the
// radiosity equation. Any solver can then be asked for it, in any scene, past any blockers.

#pragma once

#include <functional>

#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_visibility.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// A radiosity chosen at will, smooth over each patch [W/m^2]. Called from several threads.
using RadiosityField = std::function<Rgb(PatchId patch, const Vec3& position)>;

// The irradiance that the field sends to a point on the front of a patch [W/m^2]: for fields that are smooth
// on the scale of a patch, exact past whatever blocks but for kSourceQuadratureError.
Rgb FieldIrradiance(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                    PatchId patch, const ReceiverPoint& at);

// E = B - rho H at a point of a patch [W/m^2]: with this emittance everywhere the field is the solution. It
// may be negative, which equations bear and lights do not.
Rgb ManufacturedEmittance(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                          PatchId patch, const Vec3& position);

// The scene with every patch cut into divisions x divisions tiles, each of which emits the mean of the
// manufactured emittance over it: the radiosity of this scene tends to the field as the tiles shrink. Tiles
// are patches of their own, patch by patch. REQUIRES: a power of two; the means are not negative.
Scene ManufacturedScene(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                        int divisions);

}  // namespace penumbra
