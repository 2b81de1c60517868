// solver/base/read_file.h
//
// Reads all bytes of a file or fails. If memory or a disk fails, a standard stream ends early as if the file
// had ended; ReadFileBytes() and ReadFileStart() report an error instead.

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace penumbra {

// The error that a file cannot be read. what() is the reason in a few words: "there is no such file", "it is
// a directory".
class ReadFailure : public std::runtime_error {
 public:
  ReadFailure(const std::string& why, bool opened) : std::runtime_error(why), opened_(opened) {}
  // False if the file could not be opened; true if the file was opened but could not be read.
  bool Opened() const { return opened_; }

 private:
  bool opened_;
};

// All bytes of a file, or all that a device or a pipe delivers. Throws ReadFailure, and std::bad_alloc if the
// memory is exhausted.
std::string ReadFileBytes(const std::string& path);

// All that standard input delivers. Throws the same exceptions as ReadFileBytes().
std::string ReadStandardInput();

// The first `count` bytes of a file, or all bytes of a shorter file. Throws the same exceptions as
// ReadFileBytes().
std::string ReadFileStart(const std::string& path, std::size_t count);

}  // namespace penumbra
