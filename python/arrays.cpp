#include "python/arrays.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "solver/base/check.h"

namespace penumbra {
namespace {

namespace py = pybind11;

std::string ShapeText(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

NumberArray NumbersOf(const py::object& value, const std::string& name) {
  NumberArray numbers = NumberArray::ensure(value);
  if (numbers) return numbers;
  PyErr_Clear();
  throw py::type_error(fmt::format("{} is no array of numbers", name));
}

}  // namespace

std::vector<Vec3> RowsOf(const py::object& value, const std::string& name) {
  const NumberArray array = NumbersOf(value, name);
  const bool is_row = array.ndim() == 1 && array.shape(0) == 3;
  const bool is_empty = array.size() == 0 && array.ndim() <= 2;
  if (!is_row && !is_empty && (array.ndim() != 2 || array.shape(1) != 3))
    throw InputError(fmt::format("{} has the shape {}; give (n, 3)", name, ShapeText(array)));
  std::vector<Vec3> rows(static_cast<std::size_t>(array.size()) / 3);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = Eigen::Map<const Vec3>(array.data() + 3 * i);
  return rows;
}

Vec3 VectorOf(const py::object& value, const std::string& name) {
  const NumberArray array = NumbersOf(value, name);
  if (array.ndim() != 1 || array.size() != 3)
    throw InputError(fmt::format("{} has the shape {}; give three numbers", name, ShapeText(array)));
  const Vec3 vector = Eigen::Map<const Vec3>(array.data());
  if (!vector.allFinite()) throw InputError(fmt::format("{} is infinite or nan; give three numbers", name));
  return vector;
}

Rgb ColourOf(const py::object& value, const std::string& name) {
  const NumberArray array = NumbersOf(value, name);
  if (array.size() != 1) return VectorOf(value, name).array();
  const double grey = *array.data();
  if (!(std::abs(grey) <= std::numeric_limits<double>::max()))
    throw InputError(fmt::format("{} is infinite or nan; give a number", name));
  return Rgb::Constant(grey);
}

py::array_t<double> ArrayOfRows(std::size_t count, const std::function<Rgb(std::size_t)>& row) {
  py::array_t<double> array({static_cast<py::ssize_t>(count), py::ssize_t{3}});
  double* out = array.mutable_data();
  for (std::size_t i = 0; i < count; ++i) Eigen::Map<Rgb>(out + 3 * i) = row(i);
  return array;
}

std::vector<ProbePoint> ProbePointsOf(const py::object& points, const py::object& normals) {
  const std::vector<Vec3> positions = RowsOf(points, "points"), directions = RowsOf(normals, "normals");
  if (positions.size() != directions.size() && directions.size() != 1)
    throw InputError(
        fmt::format("there are {} points and {} normals; give a normal for each point, or one for all",
                    positions.size(), directions.size()));
  std::vector<ProbePoint> list;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    list.push_back({positions[i], directions[directions.size() == 1 ? 0 : i]});
    if (!list.back().position.allFinite() || !list.back().normal.allFinite())
      throw InputError(fmt::format("point {}: a coordinate is infinite or nan; give numbers", i));
  }
  return list;
}

}  // namespace penumbra
