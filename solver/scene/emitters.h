// solver/scene/emitters.h
//
// The emitters of a scene, and the factors by which a user multiplies the emittances of named emitters.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The unit that counts as one emitter: a face, an object or a material.
enum class EmitterUnit : std::uint8_t {
  kFace,      // each emitting face is an emitter; two faces that form one patch count as one emitter
  kObject,    // all emitting faces of an object or group together are one emitter
  kMaterial,  // all faces with the same emitting material together are one emitter
};

// Returns, for each emitter of the scene, the patches that form the emitter. Each patch that emits belongs to
// exactly one emitter. The indices of the patches of an emitter are ascending, and emitters are sorted by
// their first patch.
std::vector<std::vector<PatchId>> EmittersOf(const Scene& scene, EmitterUnit unit);

// A factor on the emittance of the object, group or material called NAME, or of the face with the number
// NAME. The forms `object:NAME`, `material:NAME` and `face:NUMBER` distinguish objects, materials and faces
// of the same name.
struct Dimming {
  std::string name;
  Rgb factor = Rgb::Ones();  // the factors on the emitter's light in each colour channel, at least 0
};

// For each patch, the product of the factors of all Dimming objects that name the patch; 1 for patches that
// no Dimming names. Throws InputError, without a file name, if a name is unknown or names no emitter. Throws
// InputError also if the name in a Dimming is that of an object and of a material with different emitters, or
// if two named faces form one patch. If two faces form one patch, a factor for one face applies to both
// faces.
std::vector<Rgb> DimmingFactors(const Scene& scene, std::span<const Dimming> dimmings);

// Multiplies the emittance of each patch, and of the faces of the patch, by the factor of the patch. If
// patches of one material have different factors, the material is divided into several materials. Throws
// InputError if an emittance would exceed kLargestEmittance. REQUIRES: there is one factor for each patch.
void ScaleEmittance(Scene& scene, std::span<const Rgb> factor_of_patch);

// Returns a copy of the scene in which only the given patches emit: the emittance of all other patches is
// zero. REQUIRES: `patches` is ascending.
Scene LitOnlyBy(const Scene& scene, std::span<const PatchId> patches);

}  // namespace penumbra
