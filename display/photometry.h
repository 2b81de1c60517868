// display/photometry.h
//
// Photometry: illuminance in lux and luminous flux in lumens from the three radiometric channels in watts.

#pragma once

#include <cstdint>

#include "solver/geometry/vec.h"

namespace penumbra {

enum class LightUnit : std::uint8_t {
  kWatts,  // W/m^2 for each of red, green and blue
  kLux,    // lux = lm/m^2, one value for all channels
};

// The luminous efficacy of white light that Radiance uses [lm/W], and the weights of red, green and blue in
// luminance (Ward, The RADIANCE lighting simulation and rendering system, 1994). The three weights add up to
// 1, so that grey light of 1 W/m^2 in each channel is 179 lux.
inline constexpr double kLuminousEfficacy = 179;
inline constexpr double kRedShare = 0.265, kGreenShare = 0.670, kBlueShare = 0.065;

// Converts radiometric to photometric quantities: an irradiance [W/m^2] to an illuminance [lux], or a power
// [W] to a luminous flux [lm].
inline double Lux(const Rgb& light) {
  return kLuminousEfficacy * (kRedShare * light[0] + kGreenShare * light[1] + kBlueShare * light[2]);
}

}  // namespace penumbra
