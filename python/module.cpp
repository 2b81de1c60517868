// The Python module penumbra.core; the package penumbra shows what it defines.

#include <pybind11/pybind11.h>

#include "python/bindings.h"
#include "python/python_errors.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

constexpr int kMostThreads = 1024;

void SetThreads(int threads) {
  if (threads < 0 || threads > kMostThreads) throw InputError("threads is not an integer from 0 to 1024");
  SetThreadCount(threads);
}

}  // namespace
}  // namespace penumbra

PYBIND11_MODULE(core, module) {
  pybind11::options options;
  options.disable_function_signatures();  // the docstrings tell them
  module.attr("__version__") = PENUMBRA_VERSION;
  penumbra::DefineErrors(module);
  penumbra::BindScene(module);
  penumbra::BindMesh(module);
  penumbra::BindSolution(module);
  penumbra::BindSolver(module);
  penumbra::BindFormFactors(module);
  penumbra::BindPictures(module);
  module.def(
      "set_threads", &penumbra::SetThreads, pybind11::arg("threads"),
      "set_threads(threads)\n\nThe number of threads for all later work of the process; 0: all processors. "
      "Results do not depend on it.");
  module.def("threads", &penumbra::ThreadCount, "threads() -> int\n\nThe number of threads for work.");
}
