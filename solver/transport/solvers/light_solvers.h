// solver/transport/solvers/light_solvers.h

#pragma once

#include "solver/transport/solvers/light_solver.h"

namespace penumbra {

// The registry of all radiosity solvers; the first solver in the registry is the default.
LightSolverRegistry& LightSolvers();

}  // namespace penumbra
