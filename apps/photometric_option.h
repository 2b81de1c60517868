// apps/photometric_option.h

#pragma once

#include <CLI/CLI.hpp>

#include "display/photometry.h"

namespace penumbra {

// Adds the flag --photometric to the command line, which sets `unit` to LightUnit::kLux.
CLI::Option* AddPhotometricOption(CLI::App& app, LightUnit* unit);

}  // namespace penumbra
