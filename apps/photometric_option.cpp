#include "apps/photometric_option.h"

#include <fmt/format.h>

namespace penumbra {

CLI::Option* AddPhotometricOption(CLI::App& app, LightUnit* unit) {
  return app.add_flag_callback(
      "--photometric", [unit] { *unit = LightUnit::kLux; },
      fmt::format(
          "Light in lux instead of W/m^2 of three channels: {:g} * ({:g} red + {:g} green + {:g} blue)",
          kLuminousEfficacy, kRedShare, kGreenShare, kBlueShare));
}

}  // namespace penumbra
