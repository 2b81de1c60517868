// mesh/pipeline/link_options.h
//
// The link options are those options of a radiosity solve on which its links between elements depend
// (SolveOption::links_depend). A solve that reuses the links of an earlier solve must use the earlier solve's
// values of the link options.

#pragma once

#include <string_view>

#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// True if `name` is the name of a link option, written as on the command line but without leading dashes.
bool IsLinkOption(std::string_view name);

// Copies the values of all link options from `from` to `to`.
void TakeLinkOptions(const PipelineOptions& from, PipelineOptions* to);

}  // namespace penumbra
