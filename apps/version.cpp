#include "apps/version.h"

#include <string_view>

namespace penumbra {

std::string VersionLine() {
  const std::string_view commit = CommitOfBuild();
  std::string line = "penumbra " PENUMBRA_VERSION;
  if (!commit.empty()) line += " (" + std::string(commit) + ")";
  return line;
}

}  // namespace penumbra
