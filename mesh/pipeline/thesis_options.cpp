#include "mesh/pipeline/thesis_options.h"

#include "mesh/pipeline/option_table.h"

namespace penumbra {
namespace {

// Of the office, the thesis (7.1) tells eps, max-leaf-dsets and min-discontinuity-weight. The thesis names
// the parameters min-area, relative-cutoff, nudge and source-push-off without values (Appendix A). With
// min-area 0.015, the scene `office` has about as many leaves as the office of the thesis. The two distances
// are "small": 1e-5 m is a millionth of an office. A backprojection that collapses short segments
// (min-backprojection-segment) is left out, because exact clipping finds the same shadows much sooner.
constexpr ThesisSetting kSettings[] = {{"eps", "0.1"},
                                       {"min-area", "0.015"},
                                       {"discontinuities", "ranked"},
                                       {"weight", "thesis"},
                                       {"min-discontinuity-weight", "100"},
                                       {"corner-divisions", "0"},
                                       {"max-leaf-dsets", "10"},
                                       {"keep-hidden-discontinuities", "on"},
                                       {"eee", "0"},
                                       {"error-samples", "1"},
                                       {"refine", "transport"},
                                       {"corrections", "0"},
                                       {"acceleration", "none"},
                                       {"scheme", "jacobi"},
                                       {"oracle", "thesis"},
                                       {"multigrid", "off"},
                                       {"relative-cutoff", "0.001"},
                                       {"nudge", "1e-5"},
                                       {"source-push-off", "1e-5"},
                                       {"crowded-splits", "0"}};

}  // namespace

std::span<const ThesisSetting> AllThesisSettings() { return kSettings; }

void SetAsThesis(bool as_thesis, PipelineOptions* options) {
  if (options->as_thesis == as_thesis) return;
  options->as_thesis = as_thesis;
  const PipelineOptions defaults;
  for (const ThesisSetting& setting : kSettings) {
    const OptionField& field = FindOption(setting.option)->field;
    const OptionValue value = ParseValue(field, setting.value);
    if (as_thesis)
      field.set(value, options);
    else if (field.get(*options) == value)
      field.set(field.get(defaults), options);
  }
}

OptionField AsThesisField() {
  OptionField field = FlagField(&PipelineOptions::as_thesis);
  field.set = [](const std::optional<OptionValue>& value, PipelineOptions* options) {
    PENUMBRA_CHECK(value.has_value());
    SetAsThesis(std::get<bool>(*value), options);
  };
  return field;
}

}  // namespace penumbra
