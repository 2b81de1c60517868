// solver/base/read_file.h
//
// The bytes of files: all of them, or an error. A stream that ends early because memory or a disk fails looks
// like the end of a file; here it does not.

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace penumbra {

// Why a file cannot be read, in a few words: "there is no such file", "it is a directory".
class ReadFailure : public std::runtime_error {
 public:
  ReadFailure(const std::string& why, bool opened) : std::runtime_error(why), opened_(opened) {}
  // False: there is no file to be read. True: there is one, and it failed on the way.
  bool Opened() const { return opened_; }

 private:
  bool opened_;
};

// All bytes of a file, or what a device or a pipe brings. Throws ReadFailure, and std::bad_alloc where memory
// ends.
std::string ReadFileBytes(const std::string& path);

// The first `count` bytes, all if there are fewer. Throws the same.
std::string ReadFileStart(const std::string& path, std::size_t count);

}  // namespace penumbra
