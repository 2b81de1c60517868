// python/python_errors.h
//
// Errors and warnings as Python has them, in the words of its users.

#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace penumbra {

// The message as Python says it: `--max-reflectance` becomes `max_reflectance`, `--no-x` becomes `x=False`;
// control characters and bytes that are no UTF-8 are escaped.
std::string InPythonWords(const std::string& message);

// Defines InputError and PenumbraWarning in the module. From then on, errors of the library arrive in Python
// as InputError, errors of memory as MemoryError.
void DefineErrors(pybind11::module_& module);

// Warns as warnings.warn(message, PenumbraWarning) does, of the line that called into the module. Throws if
// the user has made errors of warnings.
void Warn(const std::string& message);

// Throws TypeError: `function` takes no argument called `name`; the message names those of `known` that are
// nearest to it.
[[noreturn]] void ThrowUnknownKeyword(const std::string& function, const std::string& name,
                                      const std::vector<std::string>& known);

// "'a', 'b' and 'c'", from the nearest to `name` on; empty if none is near.
std::string NearNames(const std::string& name, const std::vector<std::string>& known);

}  // namespace penumbra
