// python/solve_keywords.h
//
// The options of a solve as keyword arguments of Python functions, made from OptionTable(). A keyword
// argument has the same name as the option's key in reports, for example `min_area`.

#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "python/keywords.h"

namespace penumbra {

// The keyword arguments that set the options of a solve; `solver` comes first, because other options depend
// on the solver. A keyword argument throws TypeError for a value of a wrong type. A keyword argument throws
// InputError for a value that is not allowed or that the chosen solver does not use.
std::vector<Keyword> SolveKeywords(PipelineOptions* solving);

// Throws InputError if options of the solve contradict each other, or if a distance among the options is too
// large for the scene.
void CheckSolveKeywords(const pybind11::kwargs& given, const PipelineOptions& solving, const Scene& scene);

// Returns a dictionary that describes every option of a solve: {name: {"kind", "unit", "default", "choices",
// "solver", "group", "help"}}.
pybind11::dict DescribeOptions();

// Returns a text with a paragraph for each option of a solve, for docstrings.
std::string OptionsText();

}  // namespace penumbra
