// apps/options_used.h
//
// Converts the options of a command to JSON, and back. The JSON of the options is part of reports and of
// solution files, and the command-line option -v prints this JSON.

#pragma once

#include <nlohmann/json.hpp>

#include "apps/scene_arguments.h"
#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// All options that a user can set, with the values that are used, as JSON. The key of an option is the
// option's name with '_' instead of '-'. If `resolved` is null, no scene is solved, and the JSON contains
// only the options for reading the scene.
nlohmann::ordered_json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved);
// The inverse of OptionsUsed(): if the returned options are resolved and passed to OptionsUsed(), the result
// equals `options`. Throws nlohmann::json::exception if a value has the wrong type. Throws InputError if an
// option is missing, or if the value of an option is an unknown name.
PipelineOptions SolvingFrom(const nlohmann::ordered_json& options);
// Prints the section "Options used:" to standard error. A run with the printed options gives the same result
// as the run that printed them.
void PrintOptionsUsed(const nlohmann::ordered_json& options);

}  // namespace penumbra
