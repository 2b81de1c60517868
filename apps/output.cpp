#include "apps/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "solver/base/check.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void FailToWrite(const std::string& path, const std::string& why) {
  throw InputError(fmt::format("{}: error: cannot write: {}; name a place that can be written", path, why));
}

// Devices and pipes are written to as they stand; only files are replaced.
bool IsDevice(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
}

bool WriteBytes(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  if (file) file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  return static_cast<bool>(file);
}

}  // namespace

void CheckWritable(const std::string& path) {
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
  if (IsDevice(*path)) {
    if (!WriteBytes(*path, text)) FailToWrite(*path, std::strerror(errno));
    return;
  }
  const std::string temporary = *path + ".tmp";
  std::error_code ignored;
  if (WriteBytes(temporary, text) && std::rename(temporary.c_str(), path->c_str()) == 0) return;
  const int error = errno;
  fs::remove(temporary, ignored);
  FailToWrite(*path, std::strerror(error));
}

}  // namespace penumbra
