// mesh/pipeline/link_options.h
//
// The link options are the options of a solve that determine its links (SolveOption::links_depend). A solve
// that continues from the links of another solve must use that solve's values.

#pragma once

#include <string_view>

#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// True if `name` is the name of a link option, as on the command line but without dashes.
bool IsLinkOption(std::string_view name);

// Copies the values of all link options from `from` to `to`.
void TakeLinkOptions(const PipelineOptions& from, PipelineOptions* to);

}  // namespace penumbra
