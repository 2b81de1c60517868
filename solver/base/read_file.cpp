#include "solver/base/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "solver/base/processes.h"

namespace penumbra {
namespace {

[[noreturn]] void Fail(int why, bool opened) {
  switch (why) {
    case ENOMEM:
      throw std::bad_alloc();
    case ENOENT:
      throw ReadFailure("there is no such file", opened);
    case EISDIR:
      throw ReadFailure("it is a directory", opened);
    default:
      throw ReadFailure(std::string("it cannot be read: ") + std::strerror(why), opened);
  }
}

// A file that is open as long as this object.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path) : OpenFile(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  // Takes the descriptor; a negative one is an error that `errno` tells.
  explicit OpenFile(int descriptor) : file_(descriptor) {
    if (file_ < 0) Fail(errno, false);
  }
  ~OpenFile() { close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  // What the system says of its length; 0 for what has none.
  std::size_t Length() const {
    struct stat about {};
    if (fstat(file_, &about) != 0) Fail(errno, true);
    if (S_ISDIR(about.st_mode)) Fail(EISDIR, false);
    return about.st_size > 0 ? static_cast<std::size_t>(about.st_size) : 0;
  }

  // Fills the place as far as there are bytes; how many there were.
  std::size_t Read(char* to, std::size_t count) const {
    std::size_t done = 0;
    while (done < count) {
      const ssize_t got = read(file_, to + done, count - done);
      if (got == 0) break;
      if (got > 0)
        done += static_cast<std::size_t>(got);
      else if (errno != EINTR)
        Fail(errno, true);
    }
    return done;
  }

 private:
  int file_;
};

std::string ReadUpTo(const OpenFile& file, std::size_t most) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;  // of what tells no length [bytes]
  std::string bytes;
  // One byte more than the length says shows whether that is the end.
  std::size_t step = std::max(file.Length() + 1, kBlock);
  while (bytes.size() < most) {
    const std::size_t before = bytes.size(), wanted = std::min(step, most - before);
    bytes.resize(before + wanted);
    const std::size_t got = file.Read(bytes.data() + before, wanted);
    bytes.resize(before + got);
    if (got < wanted) break;
    step = std::max(kBlock, bytes.size());
  }
  return bytes;
}

}  // namespace

std::string ReadFileBytes(const std::string& path) {
  return ReadUpTo(OpenFile(path), std::numeric_limits<std::size_t>::max());
}

std::string ReadStandardInput() {
  std::string read;
  if (ProcessRank() == 0)
    read = ReadUpTo(OpenFile(dup(STDIN_FILENO)), std::numeric_limits<std::size_t>::max());
  return FromFirstProcess(std::move(read));
}

std::string ReadFileStart(const std::string& path, std::size_t count) {
  return ReadUpTo(OpenFile(path), count);
}

}  // namespace penumbra
