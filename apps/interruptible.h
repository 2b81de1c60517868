// apps/interruptible.h

#pragma once

#include <functional>

#include "solver/base/progress.h"

namespace penumbra {

// Runs the work with a context that shows its progress as a line on standard error, where that is a terminal,
// and that an interrupt (Ctrl-C) cancels; a second interrupt kills. Throws Interrupted if it was cancelled,
// and whatever the work throws; the line is erased in any case.
void RunInterruptible(const std::function<void(const ExecutionContext&)>& work);

}  // namespace penumbra
