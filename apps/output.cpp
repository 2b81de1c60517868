#include "apps/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "apps/commands.h"
#include "apps/messages.h"
#include "solver/base/check.h"
#include "solver/base/whole_file.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardOutput = "standard output";

bool IsSame(const struct stat& a, const struct stat& b) {
  return S_ISREG(a.st_mode) && S_ISREG(b.st_mode) && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// A descriptor of the standard streams that is closed would be given to the next file that is opened.
void Occupy(int stream, int mode) {
  if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) return;
  const int file = open("/dev/null", mode);  // the other way round: using it is an error
  if (file >= 0 && file != stream) {
    dup2(file, stream);
    close(file);
  }
}

}  // namespace

void PrepareStreams() {
  Occupy(STDIN_FILENO, O_WRONLY);
  Occupy(STDOUT_FILENO, O_RDONLY);
  Occupy(STDERR_FILENO, O_RDONLY);
  // What these would kill ends with an error of the writing instead, which cleans up.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool OutputArrived() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const int why = errno;
  if (!flushed && why != EPIPE)
    Say(fmt::format("{}: error: cannot write: {}", kStandardOutput, std::strerror(why)));
  return flushed && std::ferror(stdout) == 0 && !MessageFailed();
}

bool IsSameFile(const std::string& a, const std::string& b) {
  struct stat of_a = {}, of_b = {};
  const bool has_a = stat(a.c_str(), &of_a) == 0, has_b = stat(b.c_str(), &of_b) == 0;
  if (has_a && has_b) return IsSame(of_a, of_b);
  if (has_a || has_b) return false;
  std::error_code error;
  const fs::path path_a = fs::weakly_canonical(fs::absolute(ResolveSymlinks(a)), error);
  return !error && path_a == fs::weakly_canonical(fs::absolute(ResolveSymlinks(b)), error) && !error;
}

void CheckWritable(const std::string& path) {
  if (path.empty())
    throw InputError("penumbra: error: cannot write: the name of the file is empty; give one");
  CheckCanWrite(path);
}

void OutputFiles::Add(const std::string& option, const std::string& path) {
  for (const Output& other : outputs_)
    if (IsSameFile(path, other.path))
      throw UsageError(
          fmt::format("{} '{}' is the file of {}, too; name another", option, path, other.option));
  CheckWritable(path);
  outputs_.push_back({option, path});
}

void OutputFiles::RefuseInput(const std::string& path) const {
  for (const Output& output : outputs_)
    if (IsSameFile(path, output.path))
      throw UsageError(fmt::format("{} '{}' is a file that is read; name another, so that it is kept",
                                   output.option, output.path));
  struct stat of_input = {}, of_output = {};
  if (stat(path.c_str(), &of_input) == 0 && fstat(STDOUT_FILENO, &of_output) == 0 &&
      IsSame(of_input, of_output))
    throw UsageError(fmt::format("{} goes to '{}', which is read; name another file", kStandardOutput, path));
}

void WriteResult(const std::optional<std::string>& path, const std::string& text) {
  if (path) return WriteWholeFile(*path, text);
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return;
  if (errno == EPIPE) throw PipeClosed();
  FailToWrite(kStandardOutput, std::strerror(errno));
}

}  // namespace penumbra
