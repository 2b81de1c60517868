// solver/scene/scene_options.h

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

struct Material;

// How a scene file is understood.
struct SceneOptions {
  bool emission_is_radiance = false;  // Ke is radiance [W/(m^2 sr)] instead of emittance: multiplied by pi
  bool two_sided = false;  // every face is repeated, reversed, after the last: face i's back is n + i
  std::optional<double> max_reflectance =
      std::nullopt;  // in [0, 1): larger reflectances are clamped instead of refused
  // May give the materials that were read other values, before patches are built: of faces in one plane the
  // one that emits is seen.
  std::function<void(std::vector<Material>&)> change_materials = nullptr;
  bool strict = false;  // what would be repaired and warned about is refused
  bool flip = false;    // every face is turned: its vertices run the other way round
  // Hears of every material library before it is opened, and may throw.
  std::function<void(const std::string& path)> before_library = nullptr;
};

}  // namespace penumbra
