// mesh/pipeline/option_entries.h

#pragma once

#include <vector>

#include "mesh/pipeline/option_table.h"

namespace penumbra {

// The entries of OptionTable(). Other code calls OptionTable() instead.
std::vector<SolveOption> OptionEntries();

}  // namespace penumbra
