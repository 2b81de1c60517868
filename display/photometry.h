// display/photometry.h
//
// Light as people see it: lux and lumens from the three channels in watts.

#pragma once

#include <cstdint>

#include "solver/geometry/vec.h"

namespace penumbra {

enum class LightUnit : std::uint8_t {
  kWatts,  // W/m^2, of red, green and blue
  kLux,    // lm/m^2
};

// The luminous efficacy of white light that Radiance uses [lm/W], and the share of each channel in what the
// eye sees (Ward, The RADIANCE lighting simulation and rendering system, 1994). The shares add up to 1, so
// that grey light of 1 W/m^2 in each channel is 179 lux.
inline constexpr double kLuminousEfficacy = 179;
inline constexpr double kRedShare = 0.265, kGreenShare = 0.670, kBlueShare = 0.065;

// The illuminance [lux] of an irradiance [W/m^2], the luminous flux [lm] of a power [W], and so on.
inline double Lux(const Rgb& light) {
  return kLuminousEfficacy * (kRedShare * light[0] + kGreenShare * light[1] + kBlueShare * light[2]);
}

}  // namespace penumbra
