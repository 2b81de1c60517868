// apps/options_used.h
//
// The options of a command: printed in reports and with -v, stored in solution files, and read back.

#pragma once

#include <nlohmann/json.hpp>

#include "apps/scene_arguments.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// All options that a user can set, with the values in use. The key of an option is its name with '_' instead
// of '-'. Without `resolved`, the result lists only options of the scene, because nothing is solved.
nlohmann::ordered_json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved);
// The inverse of OptionsUsed(): OptionsUsed() of the result, resolved, equals `options`. Throws
// nlohmann::json::exception; throws InputError if an option is missing or names a choice that does not exist.
PipelineOptions SolvingFrom(const nlohmann::ordered_json& options);
// Prints the block "Options used:" to standard error. The same options, given again, have the same effect.
void PrintOptionsUsed(const nlohmann::ordered_json& options);

}  // namespace penumbra
