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
  bool emission_is_radiance = false;  // if true, Ke is a radiance [W/(m^2 sr)], and pi * Ke is the emittance
  bool two_sided = false;             // if true, each of the n faces i gets a reversed copy, the face n + i
  // The upper limit of reflectances, in [0, 1), to which larger reflectances are clamped. If max_reflectance
  // is not set, reflectances outside [0, 1) are an error.
  std::optional<double> max_reflectance = std::nullopt;
  // A face that is not planar is cut into triangles if (distance of a vertex from the face's plane) /
  // (diameter of the face) is at most max_off_plane; otherwise the face is an error. If max_off_plane is not
  // set, kCutTolerance is used.
  std::optional<double> max_off_plane = std::nullopt;
  // A function that may change the materials of the scene that was read. The scene reader calls
  // change_materials before patches are built, because emittance decides which of two overlapping faces is
  // visible.
  std::function<void(std::vector<Material>&)> change_materials = nullptr;
  bool strict = false;  // if true, faces that would be repaired with a warning are errors
  bool flip = false;    // if true, the order of the vertices of every face is reversed
  // The unit of length of the file, and the axis of the file that points up. If `unit` or `up` is not set,
  // its value is defined by the file, or else by the file's format. If neither the file nor its format
  // defines them, the unit of length is the metre, and z points up.
  std::optional<LengthUnit> unit = std::nullopt;
  std::optional<UpAxis> up = std::nullopt;
  // A function that is called with the path of every material library before the library is opened; the
  // function may throw an exception.
  std::function<void(const std::string& path)> before_library = nullptr;
};

}  // namespace penumbra
