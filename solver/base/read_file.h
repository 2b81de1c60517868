// solver/base/read_file.h
//
// Reads all bytes of a file, or reports an error. A standard C++ stream does not report a failing disk or
// exhausted memory, but ends as if the file had ended.

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace penumbra {

// The exception thrown if a file cannot be read. The message what() of a ReadFailure is the reason in a few
// words, such as "there is no such file" or "it is a directory".
class ReadFailure : public std::runtime_error {
 public:
  ReadFailure(const std::string& why, bool opened) : std::runtime_error(why), opened_(opened) {}
  // False if the file could not be opened; true if the file was opened but could not be read.
  bool Opened() const { return opened_; }

 private:
  bool opened_;
};

// Returns all bytes of a file, or all bytes that a device or a pipe delivers. Throws ReadFailure if the file
// cannot be read, and std::bad_alloc if the memory is exhausted.
std::string ReadFileBytes(const std::string& path);

// Returns all bytes of standard input. Throws the same exceptions as ReadFileBytes().
std::string ReadStandardInput();

// Returns the first `count` bytes of a file, or all bytes if the file is shorter. Throws the same exceptions
// as ReadFileBytes().
std::string ReadFileStart(const std::string& path, std::size_t count);

}  // namespace penumbra
