// solver/scene/scene_frame.h
//
// The frame in which a file gives its coordinates: the unit of length, and the axis that points up. Scenes
// are in metres, with z up.

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "solver/geometry/vec.h"

namespace penumbra {

// A unit of length: numerator / denominator metres. As a ratio, units such as the millimetre are exact, and
// 2800 mm become the number nearest to 2.8.
struct LengthUnit {
  std::string name;  // "mm"
  double numerator = 1, denominator = 1;

  double Metres() const { return numerator / denominator; }
};

// The unit with this name, such as "mm", "inch" or "foot"; or, if the text is a number in [1e-12, 1e12], a
// unit of this many metres. nullopt for other texts.
std::optional<LengthUnit> UnitNamed(std::string_view text);

// The names of all units, from small to large: "um, mm, cm, ...".
std::string UnitNames();

enum class UpAxis { kX, kY, kZ };

// The axis called "x", "y" or "z"; nullopt for other texts.
std::optional<UpAxis> UpAxisNamed(std::string_view text);
// "x", "y" or "z".
const char* NameOf(UpAxis up);

struct SceneFrame {
  LengthUnit unit = {"m"};
  UpAxis up = UpAxis::kZ;

  // A direction of the file in the axes of the scene. If y is up in the file, (x, y, z) becomes (x, -z, y),
  // as modellers do; if x is up, (x, y, z) becomes (-y, -z, x), as COLLADA defines it. Lengths do not change.
  Vec3 Direction(const Vec3& v) const;
  // A position of the file in the scene [m].
  Vec3 Position(const Vec3& v) const { return Direction(v) * unit.numerator / unit.denominator; }
  // Per axis of the scene, a length that the file gives per axis [m].
  Vec3 Step(const Vec3& step) const { return Position(step).cwiseAbs(); }
};

}  // namespace penumbra
