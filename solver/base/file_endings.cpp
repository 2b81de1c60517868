#include "solver/base/file_endings.h"

#include <filesystem>

namespace penumbra {

std::string EndingOf(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension.empty() ? extension : extension.substr(1);
}

std::string EndingError(const std::string& path, const std::vector<std::string>& endings) {
  const std::string file = "'" + path + "' ";
  if (endings.size() == 1) return file + "does not end in ." + endings[0];
  if (endings.size() == 2) return file + "ends neither in ." + endings[0] + " nor in ." + endings[1];
  std::string list;
  for (const std::string& ending : endings) list += (list.empty() ? "." : ", .") + ending;
  return file + "ends in none of " + list;
}

std::vector<std::string> Dotted(std::vector<std::string> endings) {
  for (std::string& ending : endings) ending.insert(0, ".");
  return endings;
}

}  // namespace penumbra
