// The classes Scene and Camera.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <utility>

#include "apps/camera_arguments.h"
#include "apps/commands.h"
#include "apps/export_file.h"
#include "apps/material_change.h"
#include "apps/scene_warnings.h"
#include "display/camera.h"
#include "python/array_scene.h"
#include "python/arrays.h"
#include "python/background_work.h"
#include "python/bindings.h"
#include "python/python_errors.h"
#include "python/python_scene.h"
#include "python/scene_keywords.h"
#include "solver/base/check.h"
#include "solver/scene/named_scene.h"

namespace penumbra {
namespace {

namespace py = pybind11;

// Reads or makes a scene in the background, adds what commands warn of, and warns of it.
PythonScene MakeScene(const SceneArguments& arguments, const std::function<Scene()>& make) {
  auto scene = std::make_shared<Scene>();
  RunInBackground(py::none(), [&](const ExecutionContext&) {
    *scene = make();
    for (const std::string& warning : SceneWarnings(*scene, arguments.lit))
      scene->warnings.push_back(fmt::format("{}: warning: {}", arguments.scene, warning));
  });
  for (std::string& warning : scene->warnings) {
    warning = InPythonWords(warning);
    Warn(warning);
  }
  return {std::move(scene), arguments};
}

PythonScene ReadScene(const py::object& path, const py::kwargs& given) {
  SceneArguments arguments;
  arguments.scene = BytesOf(path);
  TakeKeywords("Scene.read", given, FileKeywords(&arguments));
  SceneOptions options = arguments.reading;
  options.change_materials = [&arguments](std::vector<Material>& materials) {
    ChangeMaterials(arguments.emittance, &Material::emittance, materials);
    ChangeMaterials(arguments.reflectance, &Material::reflectance, materials);
  };
  return MakeScene(arguments, [&] { return ReadNamedScene(arguments.scene, options); });
}

// A colour for each face: one for all, or a row for each.
std::vector<Rgb> ColoursOf(const py::object& value, std::size_t count, const std::string& name) {
  const NumberArray array = NumberArray::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw py::type_error(name + " is no array of numbers");
  }
  const auto rows = static_cast<py::ssize_t>(count);
  const bool by_face =
      array.ndim() == 2 && array.shape(0) == rows && (array.shape(1) == 3 || array.shape(1) == 1);
  if (!by_face && array.size() != 1 && !(array.ndim() == 1 && array.size() == 3))
    throw InputError(
        fmt::format("{} has the shape {}; give a number, (r, g, b), or for {} faces an array of the shape "
                    "({}, 1) or ({}, 3)",
                    name, py::str(array.attr("shape")).cast<std::string>(), count, count, count));
  const bool grey = by_face ? array.shape(1) == 1 : array.size() == 1;
  std::vector<Rgb> colours;
  for (std::size_t i = 0; i < count; ++i) {
    const double* of_face = array.data() + (by_face ? i * (grey ? 1 : 3) : 0);
    colours.push_back(grey ? Rgb::Constant(*of_face) : Rgb(of_face[0], of_face[1], of_face[2]));
  }
  return colours;
}

std::vector<std::vector<std::int64_t>> FacesOf(const py::object& faces) {
  std::vector<std::vector<std::int64_t>> all;
  for (const py::handle face : faces) {
    std::vector<std::int64_t>& corners = all.emplace_back();
    for (const py::handle corner : face) {
      const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(corner.ptr()));
      if (!index) throw py::error_already_set();
      corners.push_back(index.cast<std::int64_t>());
    }
  }
  return all;
}

PythonScene SceneOf(const py::object& vertices, const py::object& faces, const py::object& reflectance,
                    const py::object& emittance, const py::kwargs& given) {
  SceneArrays arrays;
  SceneArguments arguments;
  py::object objects = py::none();
  std::vector<Keyword> keywords = FaceKeywords(&arguments.reading);
  keywords.push_back(ObjectKeyword("objects", &objects));
  keywords.push_back(TextKeyword("name", &arrays.name));
  TakeKeywords("Scene", given, keywords);
  arrays.vertices = RowsOf(vertices, "vertices");
  arrays.faces = FacesOf(faces);
  arrays.reflectance = ColoursOf(reflectance, arrays.faces.size(), "reflectance");
  arrays.emittance = ColoursOf(emittance, arrays.faces.size(), "emittance");
  if (!objects.is_none()) {
    for (const py::handle name : objects)
      arrays.objects.push_back(BytesOf(py::reinterpret_borrow<py::object>(name)));
    if (arrays.objects.size() != arrays.faces.size())
      throw InputError(fmt::format("objects has {} names for {} faces; give the object of each face",
                                   arrays.objects.size(), arrays.faces.size()));
  }
  arguments.scene = arrays.name;
  return MakeScene(arguments, [&] { return SceneFromArrays(arrays, arguments.reading); });
}

// The vertices of each face.
py::list FaceList(const PythonScene& scene) {
  py::list faces;
  for (const Face& face : scene.scene->faces)
    faces.append(
        ArrayOfRows(face.vertices.size(), [&](std::size_t i) { return Rgb(face.vertices[i].array()); }));
  return faces;
}

py::dict MaterialDict(const PythonScene& scene) {
  py::dict all;
  for (const Material& material : scene.scene->materials) {
    py::dict one;
    one["reflectance"] =
        py::make_tuple(material.reflectance[0], material.reflectance[1], material.reflectance[2]);
    one["emittance"] = py::make_tuple(material.emittance[0], material.emittance[1], material.emittance[2]);
    all[TextOfBytes(material.name)] = one;
  }
  return all;
}

py::dict ObjectDict(const PythonScene& scene) {
  py::dict all;
  for (const Object& object : scene.scene->objects)
    all[TextOfBytes(object.name)] =
        py::array_t<std::int32_t>(static_cast<py::ssize_t>(object.faces.size()), object.faces.data());
  return all;
}

double AreaOf(const Scene& scene) {
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  return area;
}

void SaveScene(const PythonScene& scene, const py::object& path, const py::object& camera) {
  const std::string to = BytesOf(path);
  if (ExportFormatError(to) || ExportsMesh(to))
    throw InputError(
        fmt::format("{}: error: a scene is written to files that end in .obj, .pbrt or .mgf", to));
  const Camera from = camera.is_none() ? ChooseCamera(*scene.scene, {}) : camera.cast<Camera>();
  ExportScene(to, *scene.scene, from);
}

Camera MakeCamera(const py::object& eye, const py::object& look_at, const py::object& up, double fov,
                  const std::string& name) {
  const Camera camera = {name, VectorOf(eye, "eye"), VectorOf(look_at, "look_at"), VectorOf(up, "up"), fov};
  ValidateCamera(camera);
  return camera;
}

py::tuple TupleOf(const Vec3& v) { return py::make_tuple(v.x(), v.y(), v.z()); }

void BindCamera(py::module_& module) {
  py::class_<Camera>(module, "Camera", "A pinhole camera. Lengths are in metres.")
      .def(py::init(&MakeCamera), py::arg("eye"), py::arg("look_at"), py::arg("up") = py::make_tuple(0, 0, 1),
           py::arg("fov") = 45.0, py::arg("name") = "",
           R"(Camera(eye, look_at, up=(0, 0, 1), fov=45, name="")

eye, look_at: three numbers, in metres; look_at is the middle of the picture.
up: the direction that is up in the picture, of any length.
fov: the vertical field of view in degrees.
Raises InputError for a camera that cannot see.)")
      .def_property_readonly(
          "eye", [](const Camera& camera) { return TupleOf(camera.eye); }, "(x, y, z) in metres.")
      .def_property_readonly(
          "look_at", [](const Camera& camera) { return TupleOf(camera.look_at); }, "(x, y, z) in metres.")
      .def_property_readonly(
          "up", [](const Camera& camera) { return TupleOf(camera.up); },
          "The direction that is up in the picture.")
      .def_readonly("fov", &Camera::vertical_fov, "The vertical field of view in degrees.")
      .def_property_readonly(
          "name", [](const Camera& camera) { return TextOfBytes(camera.name); },
          "Its name in the scene; empty if it has none.")
      .def("__repr__", [](const Camera& camera) {
        return fmt::format("Camera(eye=({:g}, {:g}, {:g}), look_at=({:g}, {:g}, {:g}), fov={:g})",
                           camera.eye.x(), camera.eye.y(), camera.eye.z(), camera.look_at.x(),
                           camera.look_at.y(), camera.look_at.z(), camera.vertical_fov);
      });
}

constexpr const char* kSceneDoc =
    R"(Scene(vertices, faces, reflectance=0.5, emittance=0.0, *, objects=None, name="scene",
      two_sided=False, flip=False, strict=False, max_reflectance=None)

A scene of flat polygons that reflect and emit light diffusely. Scene.read() reads one from a file.

vertices: numbers of shape (n, 3), in metres.
faces: the vertices of each face, from 0: integers of shape (m, k), or a sequence of m sequences. The front of
    a face is the side from which its vertices run counter-clockwise. Only the front reflects and emits.
reflectance: in [0, 1): a number, (r, g, b), or for each face a row of shape (m, 3) or (m, 1).
emittance: what a face emits of itself, in W/m^2, in the same shapes.
objects: the name of the object of each face. Coplanar triangles of one object and one material are joined.
two_sided: repeat every face, reversed, after the last: the back of face i is m + i.
flip: turn every face.
strict: refuse what is otherwise repaired and warned about.
max_reflectance: clamp larger reflectances to this.

The arrays are checked, repaired and solved as the OBJ file that save() writes of them.
Raises InputError if they cannot be used; warns with PenumbraWarning of what was repaired or looks wrong.)";

constexpr const char* kReadDoc =
    R"(read(path, *, emission_is_radiance=False, emittance={}, reflectance={}, two_sided=False, flip=False,
     strict=False, max_reflectance=None) -> Scene

Reads a scene file, or a built-in scene by its name, such as "cornell"; a file wins over a name.

emission_is_radiance: the file tells radiance in W/(m^2 sr), not emittance in W/m^2: multiply by pi.
emittance, reflectance: other values for materials: {name: value} or {name: (r, g, b)}.
The others are those of Scene().
Raises InputError, "FILE:LINE: error: what is wrong and how to mend it".)";

void BindSceneItself(py::module_& module) {
  py::class_<PythonScene> scene(module, "Scene", kSceneDoc);
  scene
      .def(py::init(&SceneOf), py::arg("vertices"), py::arg("faces"), py::arg("reflectance") = 0.5,
           py::arg("emittance") = 0.0, kSceneDoc)
      .def_static("read", &ReadScene, py::arg("path"), kReadDoc)
      .def("save", &SaveScene, py::arg("path"), py::arg("camera") = py::none(),
           "save(path, camera=None)\n\nWrites the scene as .obj (with an .mtl beside it), .pbrt or .mgf, by "
           "the "
           "ending of the path. The camera, a\nCamera, goes into formats that hold one. Raises InputError if "
           "the "
           "file cannot be written.")
      .def("__repr__", [](const PythonScene& s) {
        return fmt::format("<penumbra.Scene '{}': {} faces, {} patches>", InPythonWords(s.scene->name),
                           s.scene->faces.size(), s.scene->patches.size());
      });
  scene
      .def_property_readonly(
          "name", [](const PythonScene& s) { return TextOfBytes(s.scene->name); }, "Its name.")
      .def_property_readonly(
          "faces", &FaceList,
          "The vertices of each face [m]: a list of arrays of shape (k, 3). A face that was "
          "dropped has none.")
      .def_property_readonly(
          "materials", &MaterialDict,
          "{name: {\"reflectance\": (r, g, b), \"emittance\": (r, g, b)}}, the emittance in "
          "W/m^2.")
      .def_property_readonly("objects", &ObjectDict,
                             "{name: the numbers of its faces, an array of integers}.")
      .def_property_readonly(
          "area", [](const PythonScene& s) { return AreaOf(*s.scene); },
          "The area of all faces [m^2], what overlaps counted once.")
      .def_property_readonly(
          "bounds",
          [](const PythonScene& s) {
            const auto [low, high] = s.scene->Bounds();
            return ArrayOfRows(
                2, [&, low = low, high = high](std::size_t i) { return Rgb((i == 0 ? low : high).array()); });
          },
          "The lowest and the highest corner of its bounding box [m], of shape (2, 3).")
      .def_property_readonly(
          "cameras", [](const PythonScene& s) { return s.scene->cameras; },
          "The cameras that come with the scene; the first is the default of render().")
      .def_property_readonly(
          "warnings", [](const PythonScene& s) { return s.scene->warnings; },
          "What was repaired and what looks wrong, a line each; PenumbraWarning has told it.");
}

}  // namespace

void BindScene(py::module_& module) {
  BindCamera(module);
  BindSceneItself(module);
}

}  // namespace penumbra
