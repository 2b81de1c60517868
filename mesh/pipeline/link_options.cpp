#include "mesh/pipeline/link_options.h"

namespace penumbra {

void TakeLinkOptions(const PipelineOptions& from, PipelineOptions* to) {
  to->eps = from.eps;
  to->max_iterations = from.max_iterations;
  to->oracle = from.oracle;
  to->multigrid = from.multigrid;
  to->form_factors = from.form_factors;
  to->solver = from.solver;
  to->dense = from.dense;
}

}  // namespace penumbra
