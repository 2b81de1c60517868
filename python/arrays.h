// python/arrays.h
//
// Converts NumPy arrays to types of the C++ library, and back.

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

// A NumPy array of doubles, stored row by row; numbers of other types are converted.
using NumberArray = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// Returns the rows of an array of the shape (n, 3), or the only row of an array of the shape (3,). Throws
// InputError if the array has another shape; `name` is the name of the array in the message.
std::vector<Vec3> RowsOf(const pybind11::object& array, const std::string& name);

// Converts `value` to a vector of three numbers. Throws InputError if `value` is no vector of three numbers;
// `name` is the name of `value` in the message.
Vec3 VectorOf(const pybind11::object& value, const std::string& name);

// Converts `value`, three numbers or one number for all channels, to an RGB colour. Throws InputError unless
// each number is finite.
Rgb ColourOf(const pybind11::object& value, const std::string& name);

// Converts two arrays to points with normals; `normals` has one normal for each point, or one normal for all
// points. Throws InputError if an array has another shape, or if a coordinate is no number.
std::vector<ProbePoint> ProbePointsOf(const pybind11::object& points, const pybind11::object& normals);

// Makes a new array of the shape (count, 3), whose row i is row(i).
pybind11::array_t<double> ArrayOfRows(std::size_t count, const std::function<Rgb(std::size_t)>& row);

// Makes a read-only array over memory that belongs to `owner`; the array keeps `owner` alive.
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
