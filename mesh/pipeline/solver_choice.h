// mesh/pipeline/solver_choice.h
//
// How PipelineOptions says which solver is chosen, and what only the dense solver is told. The table of
// options asks here.

#pragma once

#include <string>

#include "mesh/pipeline/option_field.h"

namespace penumbra {

inline constexpr const char *kHierarchicalSolver = "hierarchical", *kDenseSolver = "dense";

// The name of the solver that the options choose.
std::string SolverOf(const PipelineOptions& options);

OptionField SolverField();
// PipelineOptions has a place for the basis only while the dense solver is chosen.
OptionField BasisField();
OptionField DivisionsField();

}  // namespace penumbra
