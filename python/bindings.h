// python/bindings.h
//
// The parts of the Python module. Each Bind function defines classes and functions of the module, with their
// documentation.

#pragma once

#include <pybind11/pybind11.h>

namespace penumbra {

void BindScene(pybind11::module_& module);
void BindMesh(pybind11::module_& module);
void BindSolution(pybind11::module_& module);  // REQUIRES: BindScene() and BindMesh() were called
void BindSolver(pybind11::module_& module);    // REQUIRES: BindSolution() was called
void BindFormFactors(pybind11::module_& module);
void BindPictures(pybind11::module_& module);

}  // namespace penumbra
