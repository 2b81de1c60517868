// python/python_errors.h
//
// Converts errors and warnings of the C++ library to Python exceptions and warnings, in the terms of Python
// users.

#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace penumbra {

// Replaces command line options in a message by Python's keyword arguments: `--max-reflectance` becomes
// `max_reflectance`, `--no-x` becomes `x=False`. Control characters and bytes that are not valid UTF-8 are
// escaped.
std::string InPythonWords(const std::string& message);

// Defines the Python classes InputError and PenumbraWarning in the module. After DefineErrors(), an
// InputError in C++ becomes an InputError in Python, and exhausted memory becomes MemoryError.
void DefineErrors(pybind11::module_& module);

// Issues a warning like warnings.warn(message, PenumbraWarning), for the line of Python code that called the
// module. Throws an exception if the user's warning filter turns warnings into errors.
void Warn(const std::string& message);

// Throws TypeError with the message that `function` takes no argument called `name`; the message lists the
// names in `known` that are similar to `name`.
[[noreturn]] void ThrowUnknownKeyword(const std::string& function, const std::string& name,
                                      const std::vector<std::string>& known);

// Lists the names in `known` that are similar to `name`, the most similar first: "'a', 'b' and 'c'". The
// returned text is empty if no name in `known` is similar to `name`.
std::string NearNames(const std::string& name, const std::vector<std::string>& known);

}  // namespace penumbra
