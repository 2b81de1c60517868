// display/viewer/light_change.h
//
// Lamps that the user dims, colours or switches off, and materials that he paints, while he looks at the
// result.

#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/scene/emitters.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

// Another reflectance of a material.
struct Paint {
  std::string material;
  Rgb reflectance = Rgb::Zero();

  bool operator==(const Paint& other) const {
    return material == other.material && (reflectance == other.reflectance).all();
  }
};

// The difference between the scene as it was opened and the scene that is shown.
struct LightChange {
  std::vector<Dimming> lamps;  // factors on the light of emitters; each name occurs once
  std::vector<Paint> paints;   // each material occurs once

  bool empty() const { return lamps.empty() && paints.empty(); }
  bool operator==(const LightChange& other) const;

  // Adds a factor or a reflectance, or replaces the one of the same name. A factor of 1 removes the lamp.
  void Set(const Dimming& lamp);
  void Set(const Paint& paint);
};

// The scene with these changes. Throws InputError if a name belongs to nothing, or if the values are not
// allowed: factors must be from 0 to kLargestLampFactor, reflectances in [0, 1).
Scene Changed(const Scene& scene, const LightChange& change);
inline constexpr double kLargestLampFactor = 1e6;  // as --dim

// Parses `NAME=FACTOR` or `NAME=r,g,b`, several of them separated by spaces, or `none`. NAME=on and NAME=off
// mean 1 and 0. Throws InputError if the text is none of these.
std::vector<Dimming> ParseLamps(const std::string& text);
std::vector<Paint> ParsePaints(const std::string& text);
std::string TextOf(std::span<const Dimming> lamps);  // `none` if there are none
std::string TextOf(std::span<const Paint> paints);

// A lamp as a panel lists it.
struct Lamp {
  std::string name;  // as in Dimming::name
  std::vector<PatchId> patches;
  Rgb emittance = Rgb::Zero();  // [W/m^2], of the first patch
};
// The lamps of a scene: its emitting objects if the scene has objects, else its emitting materials.
std::vector<Lamp> LampsOf(const Scene& scene);

}  // namespace penumbra::viewer
