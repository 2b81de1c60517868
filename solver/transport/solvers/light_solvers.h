// solver/transport/solvers/light_solvers.h

#pragma once

#include "solver/transport/solvers/light_solver.h"

namespace penumbra {

// All solvers; the first is the default.
LightSolverRegistry& LightSolvers();

}  // namespace penumbra
