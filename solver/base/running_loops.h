// solver/base/running_loops.h

#pragma once

namespace penumbra {

// True if a parallel loop (parallel.h) is running, in any thread.
bool LoopIsRunning();

}  // namespace penumbra
