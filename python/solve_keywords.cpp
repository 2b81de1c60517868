#include "python/solve_keywords.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <optional>
#include <variant>

#include "apps/option_checks.h"
#include "apps/scene_arguments.h"
#include "mesh/pipeline/option_table.h"
#include "python/python_errors.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

namespace py = pybind11;

const char* KindName(OptionKind kind) {
  switch (kind) {
    case OptionKind::kFlag:
      return "bool";
    case OptionKind::kInteger:
      return "int";
    case OptionKind::kNumber:
      return "float";
    case OptionKind::kChoice:
      break;
  }
  return "str";
}

// The text of a value that may be one of this kind; nothing for a value of another type.
std::optional<std::string> TextOf(const OptionField& field, const py::object& value) {
  const bool is_bool = py::isinstance<py::bool_>(value);
  const bool is_int = py::isinstance<py::int_>(value) && !is_bool;
  switch (field.kind) {
    case OptionKind::kFlag:
      if (is_bool) return field.choices()[value.cast<bool>() ? 1 : 0];
      break;
    case OptionKind::kInteger:
      if (is_int) return py::str(value).cast<std::string>();
      break;
    case OptionKind::kNumber:
      // The text of a number of Python is read back to the bit.
      if (is_int || py::isinstance<py::float_>(value)) return py::repr(value).cast<std::string>();
      break;
    case OptionKind::kChoice:
      break;
  }
  const bool by_name = field.kind == OptionKind::kFlag || field.kind == OptionKind::kChoice;
  return by_name && py::isinstance<py::str>(value) ? std::optional(value.cast<std::string>()) : std::nullopt;
}

void SetOption(const SolveOption& option, const py::object& given, PipelineOptions* solving) {
  const std::string key = OptionKey(option);
  // What is left out of a call that passes every option on.
  if (given.is_none()) return;
  if (!IsObeyed(option, *solving))
    throw InputError(fmt::format("{} is of {} and means nothing to solver='{}'; leave one of them out", key,
                                 InPythonWords(OwnersOf(option)), solving->SolverName()));
  const py::object value = PlainScalar(given);
  const std::optional<std::string> text = TextOf(option.field, value);
  if (!text)
    throw py::type_error(fmt::format("{} is of the type {}; give {}", key,
                                     py::str(py::type::of(value).attr("__name__")).cast<std::string>(),
                                     AllowedValues(option.field)));
  std::optional<OptionValue> parsed;
  try {
    parsed = ParseValue(option.field, *text);
  } catch (const InputError&) {
    const bool named = option.field.kind == OptionKind::kChoice;
    const std::string near = named ? NearNames(*text, option.field.choices()) : "";
    throw InputError(fmt::format("{}={} is not {}{}", key, py::repr(value).cast<std::string>(),
                                 AllowedValues(option.field),
                                 near.empty() ? "" : fmt::format("; did you mean {}?", near)));
  }
  option.field.set(*parsed, solving);
}

py::object ValueObject(const std::optional<OptionValue>& value) {
  if (!value) return py::none();
  return std::visit([](const auto& held) { return py::object(py::cast(held)); }, *value);
}

// The solvers that obey the option; None: all.
py::object SolversOf(const SolveOption& option) {
  if (option.solver.empty() && option.form_factors.empty()) return py::none();
  std::vector<std::string> names = option.other_solvers;
  if (!option.solver.empty()) names.insert(names.begin(), option.solver);
  return py::cast(names);
}

}  // namespace

std::vector<Keyword> SolveKeywords(PipelineOptions* solving) {
  std::vector<Keyword> keywords;
  // These two decide which of the others are obeyed.
  const SolveOption &solver = *FindOption("solver"), &form_factors = *FindOption("form-factors");
  const auto add = [&](const SolveOption& option) {
    keywords.push_back({OptionKey(option),
                        [&option, solving](const py::object& value) { SetOption(option, value, solving); }});
  };
  add(solver);
  add(form_factors);
  for (const SolveOption& option : OptionTable())
    if (&option != &solver && &option != &form_factors) add(option);
  return keywords;
}

void CheckSolveKeywords(const py::kwargs& given, const PipelineOptions& solving, const Scene& scene) {
  if (given.contains("source_error") && solving.source_error && solving.max_corrections == 0)
    throw InputError(
        "source_error cuts sources for corrections, and corrections=0 makes none; leave one out");
  SceneArguments arguments;
  arguments.solving = solving;
  CheckDistances(arguments, scene);
}

py::dict DescribeOptions() {
  py::dict all;
  for (const SolveOption& option : OptionTable()) {
    py::dict one;
    one["kind"] = KindName(option.field.kind);
    one["unit"] = option.unit;
    one["default"] = ValueObject(DefaultValue(option));
    one["choices"] = option.field.kind == OptionKind::kChoice ? py::object(py::cast(option.field.choices()))
                                                              : py::object(py::none());
    one["solvers"] = SolversOf(option);
    one["form_factors"] =
        option.form_factors.empty() ? py::object(py::none()) : py::cast(option.form_factors);
    one["group"] = GroupTitle(option.group);
    one["help"] = InPythonWords(OptionHelp(option));
    all[OptionKey(option).c_str()] = one;
  }
  return all;
}

std::string OptionsText() {
  std::string text;
  for (const SolveOption& option : OptionTable()) {
    const std::optional<OptionValue> value = DefaultValue(option);
    std::string kind = KindName(option.field.kind);
    if (option.field.kind == OptionKind::kChoice)
      kind = fmt::format("'{}'", fmt::join(option.field.choices(), "' | '"));
    text += fmt::format(
        "\n{} : {}{}\n    {}\n", OptionKey(option), kind,
        value ? fmt::format(", default {}", py::repr(ValueObject(value)).cast<std::string>()) : "",
        InPythonWords(OptionHelp(option)));
  }
  return text;
}

}  // namespace penumbra
