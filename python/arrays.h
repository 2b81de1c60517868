// python/arrays.h
//
// NumPy arrays to and from the types of the library.

#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/points_csv.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// An array of doubles, rows one after another; numbers of other types are converted.
using NumberArray = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// The rows of an array of shape (n, 3), or of one row of shape (3,). Throws InputError for another shape;
// `name` says in the message what it is.
std::vector<Vec3> RowsOf(const pybind11::object& array, const std::string& name);

// One vector of three numbers. Throws InputError unless `value` is one.
Vec3 VectorOf(const pybind11::object& value, const std::string& name);

// Three channels: three numbers, or one for all. Throws InputError unless each is finite.
Rgb ColourOf(const pybind11::object& value, const std::string& name);

// Points and their normals: a normal for each point, or one for all. Throws InputError for other shapes, and
// for coordinates that are no numbers.
std::vector<ProbePoint> ProbePointsOf(const pybind11::object& points, const pybind11::object& normals);

// A new array of shape (count, 3), whose row i is row(i).
pybind11::array_t<double> ArrayOfRows(std::size_t count, const std::function<Rgb(std::size_t)>& row);

// An array that shows memory of `owner`, and keeps it alive. The array cannot be written to.
template <class Number>
pybind11::array_t<Number> ViewOf(std::shared_ptr<const void> owner, const Number* first,
                                 std::vector<pybind11::ssize_t> shape,
                                 std::vector<pybind11::ssize_t> strides) {
  using Owner = std::shared_ptr<const void>;
  const pybind11::capsule base(new Owner(std::move(owner)),
                               [](void* kept) { delete static_cast<Owner*>(kept); });
  pybind11::array_t<Number> view(std::move(shape), std::move(strides), first, base);
  view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace penumbra
