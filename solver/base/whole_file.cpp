#include "solver/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "solver/base/check.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

// Writes all bytes and closes the file; false, with errno, if something fails.
bool WriteAndClose(int file, std::string_view bytes) {
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      error = errno;
  }
  if (close(file) != 0 && error == 0) error = errno;
  errno = error;
  return error == 0;
}

// Opens a new file beside the path; its name goes to `name`. Negative, with errno, if that fails.
int OpenBeside(const std::string& path, std::string* name) {
  for (int i = 0;; ++i) {
    *name = fmt::format("{}.{}-{}.tmp", path, getpid(), i);
    const int file = open(name->c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) return file;
  }
}

// Where a chain of links leads, whether there is a file or not yet.
fs::path BehindLinks(fs::path path) {
  constexpr int kMostLinks = 40;  // as the kernel follows; a longer chain is a ring
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;
  }
  return path;
}

}  // namespace

void FailToWrite(const std::string& path, const std::string& why) {
  throw InputError(fmt::format("{}: error: cannot write: {}; name a place that can be written", path, why));
}

bool IsDevice(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) && !fs::is_directory(path, ignored);
}

void WriteWholeFile(const std::string& path, std::string_view bytes) {
  if (IsDevice(path)) {
    const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0 || !WriteAndClose(file, bytes)) FailToWrite(path, std::strerror(errno));
    return;
  }
  const fs::path target = BehindLinks(path);
  std::string temporary;
  const int file = OpenBeside(target.string(), &temporary);
  if (file >= 0 && WriteAndClose(file, bytes) && std::rename(temporary.c_str(), target.c_str()) == 0) return;
  const int why = errno;
  if (file >= 0) unlink(temporary.c_str());
  FailToWrite(path, std::strerror(why));
}

}  // namespace penumbra
