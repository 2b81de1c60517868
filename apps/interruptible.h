// apps/interruptible.h

#pragma once

#include <functional>

#include "solver/base/progress.h"

namespace penumbra {

// Calls work(context). The context shows progress as a line on standard error if this is a terminal. An
// interrupt (Ctrl-C) cancels the context; a second interrupt kills the program. Throws Interrupted if the
// work was cancelled, and whatever the work throws. The progress line is erased in any case.
void RunInterruptible(const std::function<void(const ExecutionContext&)>& work);

}  // namespace penumbra
