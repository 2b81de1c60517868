// python/solve_keywords.h
//
// The options of a solve as arguments by name, made from OptionTable(): an option has the name of its key in
// reports, for example `min_area`.

#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "python/keywords.h"

namespace penumbra {

// Keywords that set the options; `solver` comes first, because others depend on it. They throw TypeError for
// a value of another type, and InputError for a value that is not allowed, or that the chosen solver does not
// obey.
std::vector<Keyword> SolveKeywords(PipelineOptions* solving);

// Throws InputError if options contradict each other, or are distances that are too large for the scene.
void CheckSolveKeywords(const pybind11::kwargs& given, const PipelineOptions& solving, const Scene& scene);

// Every option with what is known of it: {name: {"kind", "unit", "default", "choices", "solver", "group",
// "help"}}.
pybind11::dict DescribeOptions();

// A paragraph for each option, for docstrings.
std::string OptionsText();

}  // namespace penumbra
