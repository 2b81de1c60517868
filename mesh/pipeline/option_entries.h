// mesh/pipeline/option_entries.h

#pragma once

#include <vector>

#include "mesh/pipeline/option_table.h"

namespace penumbra {

// The entries of OptionTable(). Only OptionTable() calls this function; other code uses OptionTable().
std::vector<SolveOption> OptionEntries();

}  // namespace penumbra
