#include "solver/transport/solvers/light_solvers.h"

#include "solver/transport/solvers/dense_solver.h"
#include "solver/transport/solvers/hierarchical_solver.h"

namespace penumbra {

LightSolverRegistry& LightSolvers() {
  static LightSolverRegistry registry("solver", {HierarchicalSolverMethod(), DenseSolverMethod()});
  return registry;
}

bool SolveStepByStep(LightSolver& solver, const ExecutionContext& context, const StepObserver& observer) {
  for (std::optional<SolverStep> step = solver.Next(); step && !context.Cancelled(); step = solver.Next()) {
    context.Report(StepName(*step), 0);
    if (!solver.Step(*step, context)) break;
    if (observer) observer(*step);
  }
  return !context.Cancelled();
}

std::string_view StepName(SolverStep step) { return step == SolverStep::kIterate ? "iterate" : "correct"; }

}  // namespace penumbra
