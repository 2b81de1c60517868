#include "apps/output.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "solver/base/check.h"
#include "solver/base/whole_file.h"

namespace penumbra {

void CheckWritable(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (path.empty()) throw InputError("error: cannot write: the name of the file is empty; give one");
  if (fs::is_directory(path, ignored)) FailToWrite(path, "it is a directory");
  const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
  const std::string place = IsDevice(path) ? path : folder.string();
  if (access(place.c_str(), W_OK) != 0) FailToWrite(path, std::strerror(errno));
  if (!IsDevice(path) && !fs::is_directory(folder, ignored)) FailToWrite(path, std::strerror(ENOTDIR));
}

void WriteResult(const std::optional<std::string>& path, const std::string& text) {
  errno = 0;
  if (!path) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (std::fflush(stdout) != 0 || !written) FailToWrite("standard output", std::strerror(errno));
    return;
  }
  WriteWholeFile(*path, text);
}

}  // namespace penumbra
