// python/bindings.h
//
// The parts of the module. Each function defines classes and functions of it, with their documentation.

#pragma once

#include <pybind11/pybind11.h>

namespace penumbra {

void BindScene(pybind11::module_& module);
void BindMesh(pybind11::module_& module);
void BindSolution(pybind11::module_& module);  // after BindScene() and BindMesh()
void BindSolver(pybind11::module_& module);    // after BindSolution()
void BindFormFactors(pybind11::module_& module);
void BindPictures(pybind11::module_& module);

}  // namespace penumbra
