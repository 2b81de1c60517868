// mesh/pipeline/link_options.h
//
// The options of a solve that determine the links (SolveOption::links_depend). A solve that continues from
// the links of another solve must use that solve's values.

#pragma once

#include <string_view>

#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// True if `name` is one of these options. `name` is the option's name on the command line without dashes.
bool IsLinkOption(std::string_view name);

// Copies these options from `from` to `to`.
void TakeLinkOptions(const PipelineOptions& from, PipelineOptions* to);

}  // namespace penumbra
