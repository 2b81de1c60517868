// solver/base/read_file.h
//
// Reads all bytes of a file or fails. A standard stream that ends early because memory or a disk fails looks
// like the end of the file; these functions report an error instead.

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace penumbra {

// A file cannot be read. what() is the reason in a few words: "there is no such file", "it is a directory".
class ReadFailure : public std::runtime_error {
 public:
  ReadFailure(const std::string& why, bool opened) : std::runtime_error(why), opened_(opened) {}
  // False: the file could not be opened. True: the file was opened, and reading it failed.
  bool Opened() const { return opened_; }

 private:
  bool opened_;
};

// All bytes of a file, or all that a device or a pipe delivers. Throws ReadFailure, and std::bad_alloc if the
// memory is exhausted.
std::string ReadFileBytes(const std::string& path);

// The first `count` bytes of a file, or all bytes of a shorter file. Throws what ReadFileBytes() throws.
std::string ReadFileStart(const std::string& path, std::size_t count);

}  // namespace penumbra
