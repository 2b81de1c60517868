// mesh/pipeline/option_entries.h

#pragma once

#include <vector>

#include "mesh/pipeline/option_table.h"

namespace penumbra {

// Returns the entries of OptionTable(), the table of all options of a solve. Only OptionTable() calls
// OptionEntries(); other code uses OptionTable().
std::vector<SolveOption> OptionEntries();

}  // namespace penumbra
