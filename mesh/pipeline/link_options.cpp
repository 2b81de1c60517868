#include "mesh/pipeline/link_options.h"

#include "mesh/pipeline/option_table.h"

namespace penumbra {

bool IsLinkOption(std::string_view name) {
  const SolveOption* option = FindOption(name);
  return option && option->links_depend;
}

void TakeLinkOptions(const PipelineOptions& from, PipelineOptions* to) {
  for (const SolveOption& option : OptionTable()) {
    if (!option.links_depend) continue;
    const std::optional<OptionValue> value = option.field.get(from);
    if (value || option.field.optional) option.field.set(value, to);
  }
}

}  // namespace penumbra
