// apps/interruptible.h

#pragma once

#include <functional>

#include "solver/base/progress.h"

namespace penumbra {

// Calls work(context). If standard error is a terminal, the context shows the progress of the work as a line
// there. An interrupt (Ctrl-C) cancels the context; a second interrupt kills the program. Throws Interrupted
// if the work was cancelled; passes on other exceptions of the work. The progress line is erased in all
// cases.
void RunInterruptible(const std::function<void(const ExecutionContext&)>& work);

}  // namespace penumbra
