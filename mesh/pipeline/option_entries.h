// mesh/pipeline/option_entries.h

#pragma once

#include <vector>

#include "mesh/pipeline/option_table.h"

namespace penumbra {

// What OptionTable() holds: ask that one.
std::vector<SolveOption> OptionEntries();

}  // namespace penumbra
