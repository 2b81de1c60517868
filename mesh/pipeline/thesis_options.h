// mesh/pipeline/thesis_options.h
//
// The settings of the thesis as one option: what the thesis used for its office (7.1), and its methods where
// this program has others by default.

#pragma once

#include <span>

#include "mesh/pipeline/option_field.h"

namespace penumbra {

// One setting of the thesis: the name of an option in OptionTable(), and the text of its value.
struct ThesisSetting {
  const char* option;
  const char* value;
};

// All settings of the thesis, in the order of OptionTable().
std::span<const ThesisSetting> AllThesisSettings();

// Sets PipelineOptions::as_thesis. If as_thesis changes to true, all options of AllThesisSettings() get the
// values of the thesis. If as_thesis changes to false, those of these options that still have the values of
// the thesis get their default values. REQUIRES: the chosen solver is the hierarchical solver.
void SetAsThesis(bool as_thesis, PipelineOptions* options);

// The field of the option as-thesis, whose value SetAsThesis() sets.
OptionField AsThesisField();

}  // namespace penumbra
