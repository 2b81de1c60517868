// python/keywords.h
//
// Arguments that are given by name.

#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

namespace penumbra {

// An argument: its name, and a function that takes its value or throws.
struct Keyword {
  std::string name;
  std::function<void(const pybind11::object& value)> take;
};

// Passes the values that were given to the keywords, in the order of `known`. Throws TypeError, which names
// what is near, if a name is given that is not known.
void TakeKeywords(const std::string& function, const pybind11::kwargs& given,
                  const std::vector<Keyword>& known);

// Keywords that set a variable. None leaves it as it is.
Keyword ObjectKeyword(std::string name, pybind11::object* target);
Keyword BoolKeyword(std::string name, bool* target);
Keyword TextKeyword(std::string name, std::string* target);

// The value as a scalar of Python, where it is one of NumPy.
pybind11::object PlainScalar(const pybind11::object& value);

// A name or a path as Python's str, and back. Bytes that are no UTF-8 survive, as in file names of Python.
pybind11::object TextOfBytes(const std::string& bytes);
std::string BytesOf(const pybind11::object& path_or_name);

// A number in [0, 1). Throws TypeError or InputError for anything else.
double ShareOf(const pybind11::object& value, const std::string& name);

}  // namespace penumbra
