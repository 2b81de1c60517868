// solver/base/whole_file.h
//
// Files that are there as a whole or not at all.

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace penumbra {

// Writes the bytes to the file, beside its place under a name that nobody has, and then renamed; a link goes
// on pointing where it does, and a file that is replaced keeps its permissions. One that nobody is permitted
// to write is not replaced. Devices and pipes are written to as they stand. Throws InputError, "PATH: error:
// cannot write: why; ...", and leaves nothing behind, if that fails.
void WriteWholeFile(const std::string& path, std::string_view bytes);

struct FileToWrite {
  std::string path;
  std::string_view bytes;
};
// The same for files that belong together: none is replaced before all are written beside their places.
void WriteWholeFiles(std::span<const FileToWrite> files);

// Tries whether WriteWholeFile() can write to the path, and throws the same error if it cannot. Writes
// nothing.
void TryWholeFile(const std::string& path);

// Whether something stands there that is written to as it is.
bool IsDevice(const std::string& path);

// Where a chain of links leads, whether there is a file or not yet.
std::filesystem::path BehindLinks(std::filesystem::path path);

// The error of a place that cannot be written to, to be thrown.
[[noreturn]] void FailToWrite(const std::string& path, const std::string& why);

}  // namespace penumbra
