#include "solver/transport/solvers/light_solvers.h"

#include <algorithm>

#include "solver/transport/solvers/dense_solver.h"
#include "solver/transport/solvers/full_matrix_solver.h"
#include "solver/transport/solvers/hierarchical_solver.h"
#include "solver/transport/solvers/progressive_solver.h"
#include "solver/transport/solvers/rayrad_solver.h"
#include "solver/transport/solvers/sampled_solver.h"
#include "solver/transport/solvers/stochastic_solver.h"

namespace penumbra {

LightSolverRegistry& LightSolvers() {
  static LightSolverRegistry registry(
      "solver",
      {HierarchicalSolverMethod(), DenseSolverMethod(), SampledSolverMethod(), ProgressiveSolverMethod(),
       FullMatrixSolverMethod(), StochasticSolverMethod(), RayradSolverMethod()});
  return registry;
}

bool SolveStepByStep(LightSolver& solver, const ExecutionContext& context, const StepObserver& observer) {
  for (std::optional<SolverStep> step = solver.Next(); step && !context.Cancelled(); step = solver.Next()) {
    const SolverReport& report = solver.report();
    const double most = report.most_iterations > 0 ? report.most_iterations : 1;
    const double fraction = static_cast<double>(report.iterations.size()) / most;
    context.Report(StepName(*step), *step == SolverStep::kIterate ? std::min(fraction, 1.0) : 0);
    if (!solver.Step(*step, context)) break;
    if (observer) observer(*step);
  }
  return solver.Ready() && !solver.Next();
}

std::string_view StepName(SolverStep step) {
  switch (step) {
    case SolverStep::kIterate:
      return "iterate";
    case SolverStep::kCorrect:
      return "correct";
    case SolverStep::kSweep:
      return "sweep";
    case SolverStep::kSplit:
      return "split";
  }
  return "";
}

}  // namespace penumbra
