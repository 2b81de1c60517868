// The function form_factor().

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "apps/option_values.h"
#include "python/approximate_methods.h"
#include "python/background_work.h"
#include "python/bindings.h"
#include "python/keywords.h"
#include "python/python_errors.h"
#include "python/python_scene.h"
#include "solver/base/check.h"
#include "solver/transport/links/link_form_factor_method.h"
#include "solver/visibility/area/area_form_factor.h"
#include "solver/visibility/area/form_factor_matrix.h"
#include "solver/visibility/exact/occlusion_methods.h"
#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {
namespace {

namespace py = pybind11;

constexpr const char *kExact = "exact", *kAuto = "auto";
constexpr const char* kSampled = "sampled";  // jumps from point to point: no quadrature settles on it
// What doubles keep of a form factor, and what is worth asking for.
constexpr double kLeastTolerance = 1e-13, kMostTolerance = 1;

struct FormFactorKeywords {
  std::string method = kExact;
  std::optional<double> tolerance;
  ApproximateRequest approximate;
  py::object progress = py::none();
};

// The ways to integrate exact point factors.
std::vector<std::string> ExactMethods() {
  std::vector<std::string> names = OcclusionMethods().Names();
  std::erase(names, kSampled);
  names.insert(names.begin(), {kExact, kAuto});
  return names;
}

bool IsAmong(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

template <class Number>
std::optional<Number> NumberOrNone(const py::object& value) {
  return value.is_none() ? std::nullopt : std::optional(PlainScalar(value).cast<Number>());
}

FormFactorKeywords KeywordsOf(const py::kwargs& given) {
  FormFactorKeywords all;
  TakeKeywords(
      "form_factor", given,
      {TextKeyword("method", &all.method),
       {"tolerance", [&](const py::object& value) { all.tolerance = NumberOrNone<double>(value); }},
       {"rays", [&](const py::object& value) { all.approximate.rays = NumberOrNone<std::uint64_t>(value); }},
       {"resolution",
        [&](const py::object& value) { all.approximate.resolution = NumberOrNone<std::uint64_t>(value); }},
       {"seed",
        [&](const py::object& value) {
          all.approximate.seed = NumberOrNone<std::uint64_t>(value).value_or(1);
        }},
       ObjectKeyword("progress", &all.progress)});
  std::vector<std::string> names = ExactMethods();
  const bool is_exact = IsAmong(names, all.method);
  for (const std::string& name : ApproximateMethods())
    if (!IsAmong(names, name)) names.push_back(name);
  if (!IsAmong(names, all.method))
    throw InputError(
        fmt::format("there is no method '{}'; give one of {}", all.method, fmt::join(names, ", ")));
  if (all.tolerance && !is_exact)
    throw InputError(fmt::format(
        "tolerance is of exact point factors, and method='{}' has none; leave one out", all.method));
  if (all.tolerance && !(*all.tolerance >= kLeastTolerance && *all.tolerance <= kMostTolerance))
    throw InputError(fmt::format("tolerance={} is not a number from 1e-13 to 1", *all.tolerance));
  if (all.approximate.rays && (!Takes(all.method, "rays") || *all.approximate.rays == 0))
    throw InputError(fmt::format("rays is the number of random rays, 1 or more, and method='{}' casts {}",
                                 all.method, Takes(all.method, "rays") ? "that many" : "none"));
  if (all.approximate.resolution &&
      (!Takes(all.method, "resolution") || *all.approximate.resolution > kMostResolution))
    throw InputError(fmt::format(
        "resolution is the cells along a side of planes, at most {}, and method='{}' has {}", kMostResolution,
        all.method, Takes(all.method, "resolution") ? "not so many" : "no planes"));
  all.approximate.method = all.method;
  return all;
}

// Appends the faces that the value names: an object or a group by its name, a face by its number.
void AddFaces(const PythonScene& named, const py::object& value, std::vector<std::int32_t>* faces) {
  const Scene& scene = *named.scene;
  if (py::isinstance<py::str>(value)) {
    const std::string name = BytesOf(value);
    std::vector<std::string> names;
    bool found = false;
    for (const Object& object : scene.objects) {
      names.push_back(object.name);
      if (object.name != name) continue;
      found = true;
      faces->insert(faces->end(), object.faces.begin(), object.faces.end());
    }
    if (found) return;
    const std::string near = NearNames(name, names);
    throw InputError(
        fmt::format("{}: error: there is no object or group '{}'; {}", named.arguments.scene, name,
                    near.empty() ? fmt::format("there are {}", names.empty() ? "none" : NameList(names))
                                 : fmt::format("did you mean {}?", near)));
  }
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index) throw py::error_already_set();
  const auto face = index.cast<std::int64_t>();
  if (face < 0 || face >= static_cast<std::int64_t>(scene.faces.size()))
    throw InputError(
        fmt::format("{}: error: there is no face {}; the scene has {} faces, with the numbers from 0 on",
                    named.arguments.scene, face, scene.faces.size()));
  faces->push_back(static_cast<std::int32_t>(face));
}

std::vector<AreaPart> PartsNamed(const PythonScene& scene, const py::object& value) {
  std::vector<std::int32_t> faces;
  const bool is_one = py::isinstance<py::str>(value) || PyIndex_Check(PlainScalar(value).ptr());
  if (is_one)
    AddFaces(scene, PlainScalar(value), &faces);
  else
    for (const py::handle one : value) AddFaces(scene, py::reinterpret_borrow<py::object>(one), &faces);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  std::vector<AreaPart> parts;
  for (const std::int32_t face : faces)
    for (AreaPart& part : PartsOfFace(*scene.scene, face)) parts.push_back(std::move(part));
  if (parts.empty())
    throw InputError(fmt::format("{}: error: nothing is left of {}: it has no faces, or they were dropped",
                                 scene.arguments.scene, py::repr(value).cast<std::string>()));
  return parts;
}

py::tuple FormFactor(const PythonScene& scene, const py::object& from, const py::object& to,
                     const py::kwargs& given) {
  const FormFactorKeywords keywords = KeywordsOf(given);
  const std::vector<AreaPart> senders = PartsNamed(scene, from), receivers = PartsNamed(scene, to);
  FormFactorEstimate found;
  RunInBackground(keywords.progress, [&](const ExecutionContext& context) {
    const std::vector<std::string> approximate = ApproximateMethods();
    if (keywords.method != kExact && IsAmong(approximate, keywords.method)) {
      found = ApproximateFormFactor(*scene.scene, senders, receivers, keywords.approximate, context);
      return;
    }
    const bool is_usual = keywords.method == kExact || keywords.method == kAuto;
    const std::unique_ptr<const OcclusionMethod> method =
        is_usual ? nullptr : OcclusionMethods().Make(keywords.method, {});
    AreaFormFactorOptions options;
    options.method = method.get();
    options.tolerance = keywords.tolerance.value_or(options.tolerance);
    // What was asked for is given; without a word, what is cheap.
    if (keywords.tolerance) options.clear_tolerance = options.small_error = options.tolerance;
    options.context = &context;
    found = AreaFormFactor(*scene.scene, senders, receivers, options);
  });
  return py::make_tuple(found.factor, found.error);
}

// (F, error, area): the matrix of all faces, dense.
py::tuple AllFormFactors(const PythonScene& scene, const std::optional<double>& tolerance,
                         const py::object& progress) {
  const std::size_t count = scene.scene->faces.size();
  std::vector<std::vector<AreaPart>> faces;
  for (std::size_t i = 0; i < count; ++i)
    faces.push_back(PartsOfFace(*scene.scene, static_cast<std::int32_t>(i)));
  FormFactorMatrix matrix;
  RunInBackground(progress, [&](const ExecutionContext& context) {
    FormFactorMatrixOptions options;
    options.tolerance = tolerance.value_or(options.tolerance);
    options.context = &context;
    matrix = ComputeFormFactorMatrix(*scene.scene, faces, options);
  });
  py::array_t<double> factor({count, count}), error({count, count}), area(count);
  std::fill_n(factor.mutable_data(), count * count, 0.0);
  std::fill_n(error.mutable_data(), count * count, 0.0);
  std::copy(matrix.area.begin(), matrix.area.end(), area.mutable_data());
  for (std::size_t row = 0; row < count; ++row)
    for (std::size_t k = matrix.first[row]; k < matrix.first[row + 1]; ++k) {
      const std::size_t place = row * count + static_cast<std::size_t>(matrix.column[k]);
      factor.mutable_data()[place] = matrix.factor[k];
      error.mutable_data()[place] = matrix.error[k];
    }
  return py::make_tuple(factor, error, area);
}

}  // namespace

void BindFormFactors(py::module_& module) {
  module.def("form_factors", &AllFormFactors, py::arg("scene"), py::kw_only(),
             py::arg("tolerance") = py::none(), py::arg("progress") = py::none(),
             R"(form_factors(scene, *, tolerance=None, progress=None) -> (F, error, area)

The form factors between all faces of the scene, past the whole scene, as (n, n) arrays for n faces: F[i, j] is
the fraction of the diffuse flux that leaves the front of face i and reaches the front of face j; error[i, j] is an
upper estimate of its error. area, (n,): the area of each front in m^2, 0 for dropped faces. Each pair is
integrated once, so that area[i] F[i, j] = area[j] F[j, i] up to rounding.

tolerance: what the errors of a row may add up to, by default 1e-6.)");
  module.def(
      "form_factor", &FormFactor, py::arg("scene"), py::arg("from_"), py::arg("to"),
      R"(form_factor(scene, from_, to, *, method="exact", tolerance=None, rays=None, resolution=None, seed=1,
    progress=None) -> (F, error)

The fraction of the diffuse flux that leaves the front of some faces and reaches the front of others, past the
whole scene, as the command `form-factor` tells, to the bit; and an estimate of its error.

from_, to: the name of an object or group, the number of a face from 0, or a sequence of these.
method: "exact", the default: exact point factors past all blockers, integrated to the tolerance; "clipping",
    "backprojection", "vertex-tracing": the same, occlusion found so; "cubature", "disk", "monte-carlo", "malley",
    "hemicube" and the others that `penumbra methods` lists as form-factors: approximate.
tolerance: for the exact ones, the error that is asked for, relative to F; from 1e-13 to 1.
rays, seed: of the methods that cast rays: their number, by default a million, and the seed.
resolution: of hemicubes and their like: cells along a side of their planes.
Raises InputError for names, numbers and values that are not there.)");
}

}  // namespace penumbra
