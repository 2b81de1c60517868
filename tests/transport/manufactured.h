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

// A chosen radiosity as a function of position, smooth over each patch [W/m^2]. A RadiosityField is called
// from several threads at once.
using RadiosityField = std::function<Rgb(PatchId patch, const Vec3& position)>;

// Returns the irradiance that the chosen radiosity causes at a point on the front of a patch [W/m^2]. If the
// chosen radiosity is smooth on the scale of a patch, the irradiance is exact with any blockers, except for
// the error kSourceQuadratureError.
Rgb FieldIrradiance(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                    PatchId patch, const ReceiverPoint& at);

// Returns the emittance E = B - rho H at a point of a patch [W/m^2], where B is the chosen radiosity, rho the
// reflectance and H the irradiance. With the emittance B - rho H everywhere, B is the solution of the
// radiosity equation. The manufactured emittance may be negative, which is valid in the radiosity equation
// but not for a real light.
Rgb ManufacturedEmittance(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                          PatchId patch, const Vec3& position);

// Returns the scene with each patch cut into divisions x divisions tiles. Each tile is a patch and emits the
// mean of the manufactured emittance over the tile. Tiles are in the order of the patches that contain them.
// As the tiles shrink, the radiosity of the tiled scene converges to the chosen radiosity. REQUIRES:
// `divisions` is a power of two, and the mean emittances of tiles are not negative.
Scene ManufacturedScene(const Scene& scene, const PatchVisibility& visibility, const RadiosityField& field,
                        int divisions);

}  // namespace penumbra
