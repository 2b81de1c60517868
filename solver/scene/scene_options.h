// solver/scene/scene_options.h

#pragma once

#include <optional>

namespace penumbra {

// How a scene file is understood.
struct SceneOptions {
  bool emission_is_radiance = false;  // Ke is radiance [W/(m^2 sr)] instead of emittance: multiplied by pi
  bool two_sided = false;  // every face is repeated, reversed, after the last: face i's back is n + i
  std::optional<double> max_reflectance =
      std::nullopt;  // in [0, 1): larger reflectances are clamped instead of refused
};

}  // namespace penumbra
