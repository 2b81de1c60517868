#include "python/scene_keywords.h"

#include <fmt/format.h>

#include "python/arrays.h"
#include "solver/base/check.h"
#include "solver/scene/scene_frame.h"

namespace penumbra {
namespace {

namespace py = pybind11;

// {material: colour}, each channel by the rule.
Keyword ChangesKeyword(const std::string& name, const NumberRule& rule,
                       std::vector<MaterialChange>* changes) {
  const auto take = [name, rule, changes](const py::object& value) {
    if (value.is_none()) return;
    if (!py::isinstance<py::dict>(value))
      throw py::type_error(name + " is no dictionary; give {material: value} or {material: (r, g, b)}");
    for (const auto& [material, colour] : value.cast<py::dict>()) {
      const auto of = py::str(material).cast<std::string>();
      const Rgb rgb = ColourOf(py::reinterpret_borrow<py::object>(colour), fmt::format("{}['{}']", name, of));
      for (const double channel : rgb)
        if (!rule.holds(channel))
          throw InputError(fmt::format("{}['{}'] is {}, which is not {}", name, of, channel, rule.words));
      changes->push_back({of, rgb});
    }
  };
  return {name, take};
}

}  // namespace

std::vector<Keyword> FaceKeywords(SceneOptions* reading) {
  return {BoolKeyword("two_sided", &reading->two_sided),
          BoolKeyword("flip", &reading->flip),
          BoolKeyword("strict", &reading->strict),
          {"max_reflectance", [reading](const py::object& value) {
             if (!value.is_none()) reading->max_reflectance = ShareOf(value, "max_reflectance");
           }}};
}

std::vector<Keyword> FileKeywords(SceneArguments* arguments) {
  constexpr NumberRule kReflectance{[](double x) { return x >= 0 && x < 1; }, "a number in [0, 1)"};
  std::vector<Keyword> keywords = FaceKeywords(&arguments->reading);
  keywords.push_back(
      {"unit", [arguments](const py::object& value) {
         if (value.is_none()) return;
         const auto text = py::str(value).cast<std::string>();
         arguments->reading.unit = UnitNamed(text);
         if (!arguments->reading.unit)
           throw InputError(fmt::format(
               "unit='{}' is no unit of length; give one of {}, or a number of metres", text, UnitNames()));
       }});
  keywords.push_back({"up", [arguments](const py::object& value) {
                        if (value.is_none()) return;
                        const auto text = py::str(value).cast<std::string>();
                        arguments->reading.up = UpAxisNamed(text);
                        if (!arguments->reading.up)
                          throw InputError(fmt::format("up='{}' is not one of x, y, z", text));
                      }});
  keywords.push_back(BoolKeyword("emission_is_radiance", &arguments->reading.emission_is_radiance));
  keywords.push_back(ChangesKeyword("emittance", kEmittance, &arguments->emittance));
  keywords.push_back(ChangesKeyword("reflectance", kReflectance, &arguments->reflectance));
  return keywords;
}

}  // namespace penumbra
