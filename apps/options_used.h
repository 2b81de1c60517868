// apps/options_used.h
//
// The options that a command works with: told in reports and with -v, kept in solution files, read back.

#pragma once

#include <nlohmann/json.hpp>

#include "apps/scene_arguments.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// What a user could set and what it came to, by option name with '_' for '-'. Without `resolved` nothing is
// solved, and only what concerns the scene is listed.
nlohmann::ordered_json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved);
// The same read back: OptionsUsed() of these, resolved, gives `options` again. Throws
// nlohmann::json::exception, and InputError if an option is missing or names a choice that there is not.
PipelineOptions SolvingFrom(const nlohmann::ordered_json& options);
// The "Options used:" block, to standard error: what, given again, does the same.
void PrintOptionsUsed(const nlohmann::ordered_json& options);

}  // namespace penumbra
