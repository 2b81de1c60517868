// solver/scene/emitters.h
//
// The emitters of a scene, and factors on their emittance that a user gives by name.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// What counts as one emitter.
enum class EmitterUnit : std::uint8_t {
  kFace,      // one face; faces that share a patch count as one
  kObject,    // all emitting faces of an object or group
  kMaterial,  // all faces with one emitting material
};

// The patches of each emitter of the scene. Each patch that emits belongs to exactly one emitter. The patches
// of an emitter are ascending, and emitters are ordered by their first patch.
std::vector<std::vector<PatchId>> EmittersOf(const Scene& scene, EmitterUnit unit);

// A factor for what is called NAME: an object or group, a material, or the number of a face. `object:NAME`,
// `material:NAME` and `face:NUMBER` say which of these is meant.
struct Dimming {
  std::string name;
  Rgb factor = Rgb::Ones();  // at least 0
};

// The factor of each patch: the product of the factors of all dimmings that name the patch; 1 for patches
// that are not named. Throws InputError, without the name of a file, if a name belongs to nothing, to nothing
// that emits, or to an object and a material that are not the same emitters, or if two faces are named that
// form one patch. A face that forms a patch with another face is dimmed together with that face.
std::vector<Rgb> DimmingFactors(const Scene& scene, std::span<const Dimming> dimmings);

// Multiplies the emittance of each patch, and of its faces, by the factor of the patch. Materials whose
// patches have different factors become several materials. Throws InputError if an emittance would exceed
// kLargestEmittance. REQUIRES: there is one factor for each patch.
void ScaleEmittance(Scene& scene, std::span<const Rgb> factor_of_patch);

// The scene with the emittance of all patches but the given ones set to zero. REQUIRES: `patches` is
// ascending.
Scene LitOnlyBy(const Scene& scene, std::span<const PatchId> patches);

}  // namespace penumbra
