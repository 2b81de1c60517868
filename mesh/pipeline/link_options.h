// mesh/pipeline/link_options.h
//
// The options of a solve that say how links are made. Who goes on from the links of another solve keeps that
// one's.

#pragma once

#include <array>

#include "mesh/pipeline/pipeline.h"

namespace penumbra {

// In the words of the command line, without its dashes.
inline constexpr auto kLinkOptions = std::to_array<const char*>(
    {"eps", "iterations", "oracle", "multigrid", "form-factors", "solver", "basis", "divisions"});

// Gives `to` these options of `from`.
void TakeLinkOptions(const PipelineOptions& from, PipelineOptions* to);

}  // namespace penumbra
