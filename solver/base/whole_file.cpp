#include "solver/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

#include "solver/base/check.h"
#include "solver/base/processes.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

// Writes all bytes and closes the file; false, with errno, if something fails.
bool WriteAndClose(int file, std::string_view bytes) {
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written > 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (written == 0)
      error = ENOSPC;
    else if (errno != EINTR)
      error = errno;
  }
  if (close(file) != 0 && error == 0) error = errno;
  errno = error;
  return error == 0;
}

// Opens a new file beside the path; its name goes to `name`. Negative, with errno, if that fails.
int OpenBeside(const fs::path& path, std::string* name) {
  // Names may have 255 bytes: what is added must not make a long one too long.
  constexpr std::size_t kMostOfName = 200;
  const std::string stem = (path.parent_path() / path.filename().string().substr(0, kMostOfName)).string();
  for (int i = 0;; ++i) {
    *name = fmt::format("{}.{}-{}.tmp", stem, getpid(), i);
    const int file = open(name->c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) return file;
  }
}

// Why the file at `target` may not be replaced; 0 if it may, or is not there. Root may do anything: a file
// that is kept from everybody is kept from it as well.
int WhyKept(const fs::path& target) {
  struct stat there = {};
  if (stat(target.c_str(), &there) != 0) return errno == ENOENT ? 0 : errno;
  if (S_ISDIR(there.st_mode)) return EISDIR;
  if ((there.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0) return EACCES;
  return access(target.c_str(), W_OK) == 0 ? 0 : errno;
}

// A file beside its place, which is taken away again unless it gets there.
class Staged {
 public:
  explicit Staged(const std::string& path) : path_(path), target_(ResolveSymlinks(path)) {
    if (const int why = WhyKept(target_)) FailToWrite(path_, std::strerror(why));
    file_ = OpenBeside(target_, &temporary_);
    if (file_ < 0) FailToWrite(path_, std::strerror(errno));
    struct stat before = {};
    if (stat(target_.c_str(), &before) == 0) fchmod(file_, before.st_mode & 0777);
  }
  Staged(Staged&& other) noexcept
      : path_(std::move(other.path_)),
        target_(std::move(other.target_)),
        temporary_(std::exchange(other.temporary_, {})),
        file_(std::exchange(other.file_, -1)) {}
  ~Staged() {
    if (file_ >= 0) close(file_);
    if (!temporary_.empty()) unlink(temporary_.c_str());
  }

  void Write(std::string_view bytes) {
    if (!WriteAndClose(std::exchange(file_, -1), bytes)) FailToWrite(path_, std::strerror(errno));
  }
  void PutInPlace() {
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) FailToWrite(path_, std::strerror(errno));
    temporary_.clear();
  }

 private:
  std::string path_;
  fs::path target_;
  std::string temporary_;
  int file_ = -1;
};

void WriteToDevice(const std::string& path, std::string_view bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0 || !WriteAndClose(file, bytes)) FailToWrite(path, std::strerror(errno));
}

}  // namespace

fs::path ResolveSymlinks(fs::path path) {
  constexpr int kMostLinks = 40;  // as the kernel follows; a longer chain is a ring
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;
  }
  return path;
}

void FailToWrite(const std::string& path, const std::string& why) {
  throw InputError(fmt::format("{}: error: cannot write: {}; name a place that can be written", path, why));
}

bool IsDevice(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) && !fs::is_directory(path, ignored);
}

void CheckCanWrite(const std::string& path) {
  if (ProcessRank() > 0) return;  // the first process writes for all
  if (IsDevice(path)) {
    if (access(path.c_str(), W_OK) != 0) FailToWrite(path, std::strerror(errno));
  } else {
    const Staged trial(path);
  }
}

void WriteWholeFile(const std::string& path, std::string_view bytes) {
  const FileToWrite one{path, bytes};
  WriteWholeFiles({&one, 1});
}

void WriteWholeFiles(std::span<const FileToWrite> files) {
  if (ProcessRank() > 0) return;
  std::vector<Staged> staged;
  for (const FileToWrite& file : files) {
    if (IsDevice(file.path)) {
      WriteToDevice(file.path, file.bytes);
    } else {
      staged.emplace_back(file.path);
      staged.back().Write(file.bytes);
    }
  }
  for (Staged& file : staged) file.PutInPlace();
}

}  // namespace penumbra
