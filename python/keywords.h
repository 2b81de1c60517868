// python/keywords.h
//
// Keyword arguments of Python functions.

#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

namespace penumbra {

// A keyword argument: its name, and a function that stores the value or throws an exception.
struct Keyword {
  std::string name;
  std::function<void(const pybind11::object& value)> take;
};

// Calls Keyword::take with the given value of each keyword argument, in the order of the list `known`. Throws
// TypeError if a name is not in `known`; the message lists similar names.
void TakeKeywords(const std::string& function, const pybind11::kwargs& given,
                  const std::vector<Keyword>& known);

// Makes keyword arguments that set the variable `target`. The value None leaves the variable unchanged.
Keyword ObjectKeyword(std::string name, pybind11::object* target);
Keyword BoolKeyword(std::string name, bool* target);
Keyword TextKeyword(std::string name, std::string* target);

// Converts a NumPy scalar to a Python scalar; returns other values unchanged.
pybind11::object PlainScalar(const pybind11::object& value);

// Converts a name or a path to a Python str, and back. Bytes that are not valid UTF-8 are preserved, as in
// Python's file names.
pybind11::object TextOfBytes(const std::string& bytes);
std::string BytesOf(const pybind11::object& path_or_name);

// Converts `value` to a number in [0, 1). Throws TypeError or InputError if `value` is not a number in [0,
// 1).
double ShareOf(const pybind11::object& value, const std::string& name);

}  // namespace penumbra
