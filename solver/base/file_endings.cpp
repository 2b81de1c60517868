#include "solver/base/file_endings.h"

#include <fmt/format.h>

#include <filesystem>

namespace penumbra {

std::string EndingOf(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension.empty() ? extension : extension.substr(1);
}

std::string EndingError(const std::string& path, const std::vector<std::string>& endings) {
  const std::vector<std::string> all = Dotted(endings);
  if (all.size() == 1) return fmt::format("'{}' does not end in {}", path, all[0]);
  if (all.size() == 2) return fmt::format("'{}' ends neither in {} nor in {}", path, all[0], all[1]);
  return fmt::format("'{}' ends in none of {}", path, fmt::join(all, ", "));
}

std::vector<std::string> Dotted(std::vector<std::string> endings) {
  for (std::string& ending : endings) ending = fmt::format(".{}", ending);
  return endings;
}

}  // namespace penumbra
