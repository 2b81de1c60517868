#include "python/python_errors.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <exception>
#include <regex>

#include "apps/commands.h"
#include "apps/messages.h"
#include "apps/option_values.h"
#include "mesh/pipeline/option_table.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

namespace py = pybind11;

// The classes live as long as the interpreter.
PyObject* input_error = nullptr;
PyObject* penumbra_warning = nullptr;

PyObject* NewClass(py::module_& module, const char* name, PyObject* base, const char* doc) {
  const std::string full = fmt::format("penumbra.{}", name);
  PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), doc, base, nullptr);
  if (!made) throw py::error_already_set();
  module.attr(name) = py::reinterpret_borrow<py::object>(made);
  return made;
}

void Translate(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(error);
  } catch (const InputError& wrong) {
    PyErr_SetString(input_error, InPythonWords(wrong.what()).c_str());
  } catch (const UsageError& wrong) {
    PyErr_SetString(input_error, InPythonWords(wrong.what()).c_str());
  }
}

}  // namespace

std::string InPythonWords(const std::string& message) {
  static const std::regex kOption("--([a-z][a-z0-9]*(-[a-z0-9]+)*)");
  std::string text = OneLine(message), out;
  for (std::smatch found; std::regex_search(text, found, kOption); text = found.suffix()) {
    std::string name = found[1];
    const bool negated = name.starts_with("no-") && !FindOption(name);
    if (negated) name.erase(0, 3);
    std::replace(name.begin(), name.end(), '-', '_');
    out += found.prefix().str() + name + (negated ? "=False" : "");
  }
  return out + text;
}

void DefineErrors(py::module_& module) {
  input_error =
      NewClass(module, "InputError", PyExc_ValueError,
               "What was given cannot be used: a file, a scene, an array or the value of an option.\n\n"
               "The message is one line that says what is wrong and how to mend it.");
  penumbra_warning = NewClass(
      module, "PenumbraWarning", PyExc_UserWarning,
      "Something is likely to be wrong: with a scene, with points, or with the error that was reached.");
  py::register_exception_translator(&Translate);
}

void Warn(const std::string& message) {
  constexpr int kOfCaller = 1;
  if (PyErr_WarnEx(penumbra_warning, InPythonWords(message).c_str(), kOfCaller) != 0)
    throw py::error_already_set();
}

std::string NearNames(const std::string& name, const std::vector<std::string>& known) {
  const py::object near = py::module_::import("difflib").attr("get_close_matches")(name, known);
  std::string list;
  for (const py::handle one : near)
    list += fmt::format("{}'{}'", list.empty() ? "" : ", ", one.cast<std::string>());
  return list;
}

void ThrowUnknownKeyword(const std::string& function, const std::string& name,
                         const std::vector<std::string>& known) {
  const std::string near = NearNames(name, known);
  throw py::type_error(
      fmt::format("{}() takes no argument '{}'; {}", function, OneLine(name),
                  near.empty() ? "it takes " + NameList(known) : fmt::format("did you mean {}?", near)));
}

}  // namespace penumbra
