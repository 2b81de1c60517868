// mesh/pipeline/link_options.h
//
// The options of a solve that say how links are made (SolveOption::links_depend). Whoever goes on from the
// links of another solve keeps that one's.

#pragma once

#include <string_view>

#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// Whether `name`, in the words of the command line without its dashes, is one of them.
bool IsLinkOption(std::string_view name);

// Gives `to` these options of `from`.
void TakeLinkOptions(const PipelineOptions& from, PipelineOptions* to);

}  // namespace penumbra
