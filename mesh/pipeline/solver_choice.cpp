#include "mesh/pipeline/solver_choice.h"

namespace penumbra {
namespace {

constexpr std::uint64_t kMostDivisions = 64;

NamedValues<BasisDegree> Bases() {
  return {{"constant", BasisDegree::kConstant},
          {"linear", BasisDegree::kLinear},
          {"quadratic", BasisDegree::kQuadratic}};
}

}  // namespace

std::string SolverOf(const PipelineOptions& options) {
  return options.dense ? kDenseSolver : kHierarchicalSolver;
}

OptionField SolverField() {
  OptionField field;
  field.kind = OptionKind::kChoice;
  field.choices = [] { return std::vector<std::string>{kHierarchicalSolver, kDenseSolver}; };
  field.get = [](const PipelineOptions& from) { return OptionValue(SolverOf(from)); };
  field.set = [](const std::optional<OptionValue>& value, PipelineOptions* to) {
    const std::string name = std::get<std::string>(value.value());
    if (name != kDenseSolver && name != kHierarchicalSolver) throw InputError("no such choice: " + name);
    if (name == kHierarchicalSolver)
      to->dense.reset();
    else if (!to->dense)
      to->dense.emplace();
  };
  return field;
}

OptionField BasisField() {
  OptionField field = ChoiceField(
      [](auto& options) -> auto& { return options.dense->degree; }, Bases());
  field.get = [get = field.get](const PipelineOptions& from) {
    return from.dense ? get(from) : std::nullopt;
  };
  field.set = [set = field.set](const std::optional<OptionValue>& value, PipelineOptions* to) {
    PENUMBRA_CHECK(to->dense.has_value());
    set(value, to);
  };
  return field;
}

OptionField DivisionsField() { return IntegerField(&PipelineOptions::divisions, {1, kMostDivisions, true}); }

}  // namespace penumbra
