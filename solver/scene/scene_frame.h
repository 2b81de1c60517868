// solver/scene/scene_frame.h
//
// The coordinate frame of a scene file: the unit of length, and the axis that points up. The scenes in the
// program are in metres, with z up.

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "solver/geometry/vec.h"

namespace penumbra {

// A unit of length of numerator / denominator metres. Because a unit is stored as a ratio, units such as the
// millimetre are exact, and 2800 mm becomes the binary64 number nearest to 2.8.
struct LengthUnit {
  std::string name;  // the name of the unit of length, such as "mm"
  double numerator = 1, denominator = 1;

  double Metres() const { return numerator / denominator; }
};

// Returns the unit called `text`, such as "mm", "inch" or "foot". If the text is a number in [1e-12, 1e12],
// returns a unit of that many metres; for other texts, returns nullopt.
std::optional<LengthUnit> UnitNamed(std::string_view text);

// The names of all units of length, from small to large: "um, mm, cm, ...".
std::string UnitNames();

enum class UpAxis { kX, kY, kZ };

// The coordinate axis called "x", "y" or "z"; nullopt for other texts.
std::optional<UpAxis> UpAxisNamed(std::string_view text);
// The name of the axis: "x", "y" or "z".
const char* NameOf(UpAxis up);

struct SceneFrame {
  LengthUnit unit = {"m"};
  UpAxis up = UpAxis::kZ;

  // Converts a direction from the axes of the file to the axes of the scene, in which z is up. If y is up in
  // the file, (x, y, z) becomes (x, -z, y), as in 3D modelling programs; if x is up, (x, y, z) becomes (-y,
  // -z, x), as COLLADA defines it. Direction() does not change the length of the vector.
  Vec3 Direction(const Vec3& v) const;
  // Converts a position in the frame of the file to the frame of the scene [m].
  Vec3 Position(const Vec3& v) const { return Direction(v) * unit.numerator / unit.denominator; }
  // Converts a vector of three lengths, one for each axis of the file, to three lengths for the axes of the
  // scene [m].
  Vec3 Step(const Vec3& step) const { return Position(step).cwiseAbs(); }
};

}  // namespace penumbra
