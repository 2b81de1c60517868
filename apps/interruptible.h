// apps/interruptible.h

#pragma once

#include <functional>

#include "solver/base/progress.h"

namespace penumbra {

// Calls work(context) so that the user can interrupt the work. If standard error is a terminal, a line on the
// terminal shows the progress. An interrupt (Ctrl-C) cancels the context; a second interrupt kills the
// program. Throws Interrupted if `work` was cancelled; other exceptions of `work` are passed on. The progress
// line is erased in all cases.
void RunInterruptible(const std::function<void(const ExecutionContext&)>& work);

}  // namespace penumbra
