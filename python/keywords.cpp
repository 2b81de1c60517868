#include "python/keywords.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "python/python_errors.h"
#include "solver/base/check.h"

namespace penumbra {
namespace py = pybind11;

void TakeKeywords(const std::string& function, const py::kwargs& given, const std::vector<Keyword>& known) {
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    const auto is_it = [&](const Keyword& keyword) { return keyword.name == name; };
    if (std::any_of(known.begin(), known.end(), is_it)) continue;
    std::vector<std::string> names;
    for (const Keyword& keyword : known) names.push_back(keyword.name);
    ThrowUnknownKeyword(function, name, names);
  }
  for (const Keyword& keyword : known)
    if (given.contains(keyword.name)) keyword.take(py::object(given[keyword.name.c_str()]));
}

Keyword ObjectKeyword(std::string name, py::object* target) {
  return {std::move(name), [target](const py::object& value) { *target = value; }};
}

Keyword BoolKeyword(std::string name, bool* target) {
  const auto take = [name, target](const py::object& value) {
    if (value.is_none()) return;
    const py::object plain = PlainScalar(value);
    if (!py::isinstance<py::bool_>(plain)) throw py::type_error(name + " is neither True nor False");
    *target = plain.cast<bool>();
  };
  return {std::move(name), take};
}

Keyword TextKeyword(std::string name, std::string* target) {
  const auto take = [name, target](const py::object& value) {
    if (value.is_none()) return;
    if (!py::isinstance<py::str>(value)) throw py::type_error(name + " is no text");
    *target = BytesOf(value);
  };
  return {std::move(name), take};
}

py::object PlainScalar(const py::object& value) {
  const bool is_scalar = py::hasattr(value, "item") && py::hasattr(value, "ndim") &&
                         py::object(value.attr("ndim")).equal(py::int_(0));
  return is_scalar ? py::object(value.attr("item")()) : value;
}

py::object TextOfBytes(const std::string& bytes) {
  PyObject* text = PyUnicode_DecodeFSDefaultAndSize(bytes.data(), static_cast<py::ssize_t>(bytes.size()));
  if (!text) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(text);
}

std::string BytesOf(const py::object& path_or_name) {
  return py::module_::import("os").attr("fsencode")(path_or_name).cast<std::string>();
}

double ShareOf(const py::object& value, const std::string& name) {
  const py::object plain = PlainScalar(value);
  if (!py::isinstance<py::float_>(plain) && !py::isinstance<py::int_>(plain))
    throw py::type_error(name + " is no number");
  const double share = plain.cast<double>();
  if (!(share >= 0 && share < 1))
    throw InputError(fmt::format("{}={} is not a number in [0, 1)", name, share));
  return share;
}

}  // namespace penumbra
