// The class Mesh.

#include <fmt/format.h>

#include <cstddef>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/python_mesh.h"

namespace penumbra {
namespace {

namespace py = pybind11;

using Triangle = IrradianceMesh::Triangle;
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Rgb) == 3 * sizeof(double));
static_assert(sizeof(QuadraticInterpolant) == 6 * sizeof(Rgb));
static_assert(offsetof(QuadraticInterpolant, b2) == 1 * sizeof(Rgb) &&
              offsetof(QuadraticInterpolant, c2) == 2 * sizeof(Rgb) &&
              offsetof(QuadraticInterpolant, d) == 3 * sizeof(Rgb) &&
              offsetof(QuadraticInterpolant, e2) == 4 * sizeof(Rgb) &&
              offsetof(QuadraticInterpolant, f) == 5 * sizeof(Rgb));

constexpr py::ssize_t kNumberSize = sizeof(double);

py::ssize_t Count(const auto& list) { return static_cast<py::ssize_t>(list.size()); }

py::array_t<double> Vertices(const PythonMesh& mesh) {
  const std::vector<Vec3>& positions = mesh.mesh->positions;
  return ViewOf(mesh.mesh, positions.empty() ? nullptr : positions[0].data(), {Count(positions), 3},
                {3 * kNumberSize, kNumberSize});
}

py::array_t<std::uint32_t> Triangles(const PythonMesh& mesh) {
  const std::vector<Triangle>& triangles = mesh.mesh->triangles;
  return ViewOf(mesh.mesh, triangles.empty() ? nullptr : triangles[0].vertex.data(), {Count(triangles), 3},
                {sizeof(Triangle), sizeof(std::uint32_t)});
}

py::array_t<bool> Discontinuities(const PythonMesh& mesh) {
  const std::vector<Triangle>& triangles = mesh.mesh->triangles;
  return ViewOf(mesh.mesh, triangles.empty() ? nullptr : triangles[0].discontinuity.data(),
                {Count(triangles), 3}, {sizeof(Triangle), sizeof(bool)});
}

py::array_t<double> Coefficients(const PythonMesh& mesh) {
  const std::vector<QuadraticInterpolant>& irradiance = mesh.mesh->irradiance;
  return ViewOf(mesh.mesh, irradiance.empty() ? nullptr : irradiance[0].a.data(), {Count(irradiance), 6, 3},
                {sizeof(QuadraticInterpolant), sizeof(Rgb), kNumberSize});
}

// Inside the program a patch is a piece of a face, or of several; outside, `patch` is the number of the face.
py::array_t<std::int32_t> Patches(const PythonMesh& mesh) {
  const IrradianceMesh& m = *mesh.mesh;
  py::array_t<std::int32_t> faces(Count(m.triangles));
  std::int32_t* out = faces.mutable_data();
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const auto& [a, b, c] = m.triangles[i].vertex;
    out[i] = mesh.scene->FaceAt(m.triangles[i].patch, (m.positions[a] + m.positions[b] + m.positions[c]) / 3);
  }
  return faces;
}

py::array_t<double> OfMaterials(const PythonMesh& mesh, Rgb Material::*member) {
  const std::vector<Triangle>& triangles = mesh.mesh->triangles;
  return ArrayOfRows(triangles.size(),
                     [&](std::size_t i) { return mesh.scene->MaterialOf(triangles[i].patch).*member; });
}

constexpr const char* kMeshDoc =
    R"(A triangle mesh with the irradiance on it as a quadratic for each triangle.

At the point vertex0 + s (vertex1 - vertex0) + t (vertex2 - vertex0) of a triangle, with s, t >= 0 and
s + t <= 1, the irradiance in W/m^2 is max(0, a s^2 + b s t + c s + d t^2 + e t + f), for each channel, with
[a, b, c, d, e, f] = coefficients[triangle]. The radiosity is reflectance * irradiance + emittance.

The arrays `vertices`, `triangles`, `discontinuity` and `coefficients` show the memory of the solution without a
copy, and keep it alive. They cannot be written to.)";

}  // namespace

void BindMesh(py::module_& module) {
  py::class_<PythonMesh>(module, "Mesh", kMeshDoc)
      .def_property_readonly("vertices", &Vertices, "Positions [m], of shape (n, 3).")
      .def_property_readonly(
          "triangles", &Triangles,
          "The three vertices of each triangle, of shape (m, 3), counter-clockwise as seen from "
          "the front.")
      .def_property_readonly("patch", &Patches,
                             "The number of each triangle's face in the scene, of shape (m,).")
      .def_property_readonly(
          "coefficients", &Coefficients,
          "The six coefficients a, b, c, d, e, f for each triangle and channel [W/m^2], of shape "
          "(m, 6, 3).")
      .def_property_readonly(
          "discontinuity", &Discontinuities,
          "For each edge, from vertex k to vertex k + 1, whether it lies on a discontinuity, of "
          "shape (m, 3).")
      .def_property_readonly(
          "reflectance", [](const PythonMesh& mesh) { return OfMaterials(mesh, &Material::reflectance); },
          "The reflectance of each triangle [1], of shape (m, 3).")
      .def_property_readonly(
          "emittance", [](const PythonMesh& mesh) { return OfMaterials(mesh, &Material::emittance); },
          "The emittance of each triangle [W/m^2], of shape (m, 3).")
      .def("__len__", [](const PythonMesh& mesh) { return mesh.mesh->triangles.size(); })
      .def("__repr__", [](const PythonMesh& mesh) {
        return fmt::format("<penumbra.Mesh: {} vertices, {} triangles>", mesh.mesh->positions.size(),
                           mesh.mesh->triangles.size());
      });
}

}  // namespace penumbra
