// solver/scene/scene_options.h

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/scene_frame.h"

namespace penumbra {

struct Material;

// Options for reading a scene file.
struct SceneOptions {
  bool emission_is_radiance = false;  // Ke is radiance [W/(m^2 sr)], not emittance: multiply by pi
  bool two_sided = false;  // repeat every face, reversed, after the last: face n + i is the back of face i
  std::optional<double> max_reflectance =
      std::nullopt;  // in [0, 1): larger reflectances are clamped instead of refused
  // Faces that are off their plane by up to this part of their diameter are cut into triangles; those that
  // are farther off are refused. Nothing stands for kCutTolerance.
  std::optional<double> max_off_plane = std::nullopt;
  // A function that may change the materials that were read. The reader calls the function before patches are
  // built, because emittance decides which of two overlapping faces is visible.
  std::function<void(std::vector<Material>&)> change_materials = nullptr;
  bool strict = false;  // refuse what is otherwise repaired with a warning
  bool flip = false;    // reverse the vertices of every face
  // The unit in which the file gives lengths, and the file's axis that points up. A member that is not set
  // follows the file, or else the file's format; if both say nothing, the unit is the metre and z points up.
  std::optional<LengthUnit> unit = std::nullopt;
  std::optional<UpAxis> up = std::nullopt;
  // A function that is called with the path of every material library before the library is opened; it may
  // throw.
  std::function<void(const std::string& path)> before_library = nullptr;
};

}  // namespace penumbra
