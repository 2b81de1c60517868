#include "solver/scene/scene_frame.h"

#include <array>

#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// The definitions are exact: an international inch has 25.4 mm, a foot 12 inches, a yard 3 feet, a mile 1760
// yards; 3937 US survey feet are 1200 m.
const std::array<LengthUnit, 12>& AllUnits() {
  static const std::array<LengthUnit, 12> units = {{{"um", 1, 1e6},
                                                    {"mm", 1, 1000},
                                                    {"cm", 1, 100},
                                                    {"inch", 127, 5000},
                                                    {"dm", 1, 10},
                                                    {"foot", 381, 1250},
                                                    {"us-foot", 1200, 3937},
                                                    {"yard", 1143, 1250},
                                                    {"m", 1, 1},
                                                    {"dam", 10, 1},
                                                    {"km", 1000, 1},
                                                    {"mile", 201168, 125}}};
  return units;
}

// A number as a unit: beyond these no length of a scene can be written in ordinary numbers [m].
constexpr double kSmallestUnit = 1e-12, kLargestUnit = 1e12;

}  // namespace

std::optional<LengthUnit> UnitNamed(std::string_view text) {
  for (const LengthUnit& unit : AllUnits())
    if (unit.name == text) return unit;
  const std::optional<double> metres = ToNumber(text);
  if (!metres || !(*metres >= kSmallestUnit && *metres <= kLargestUnit)) return std::nullopt;
  return LengthUnit{std::string(text), *metres, 1};
}

std::string UnitNames() {
  std::string names;
  for (const LengthUnit& unit : AllUnits()) names += (names.empty() ? "" : ", ") + unit.name;
  return names;
}

std::optional<UpAxis> UpAxisNamed(std::string_view text) {
  for (const UpAxis up : {UpAxis::kX, UpAxis::kY, UpAxis::kZ})
    if (text == NameOf(up)) return up;
  return std::nullopt;
}

const char* NameOf(UpAxis up) { return up == UpAxis::kX ? "x" : up == UpAxis::kY ? "y" : "z"; }

Vec3 SceneFrame::Direction(const Vec3& v) const {
  // A difference from 0, not a negation: -0 would be other bits for the same number.
  if (up == UpAxis::kY) return {v.x(), 0 - v.z(), v.y()};
  if (up == UpAxis::kX) return {0 - v.y(), 0 - v.z(), v.x()};
  return v;
}

}  // namespace penumbra
