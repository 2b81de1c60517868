// apps/options_used.h
//
// The options of a command as JSON: they are printed in reports and with -v, and are stored in solution files
// and read from these.

#pragma once

#include <nlohmann/json.hpp>

#include "apps/scene_arguments.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// All options that a user can set, with the values that are used. The key of an option is its name with '_'
// instead of '-'. If `resolved` is null, no scene is solved, and the result contains only the options for
// reading the scene.
nlohmann::ordered_json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved);
// The inverse of OptionsUsed(): if the result is resolved and passed to OptionsUsed(), the output equals
// `options`. Throws nlohmann::json::exception if a value has the wrong type. Throws InputError if an option
// is missing, or if its value is a name that does not exist.
PipelineOptions SolvingFrom(const nlohmann::ordered_json& options);
// Prints the section "Options used:" to standard error. A user who gives the printed options obtains the same
// result.
void PrintOptionsUsed(const nlohmann::ordered_json& options);

}  // namespace penumbra
