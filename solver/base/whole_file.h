// solver/base/whole_file.h
//
// Writes files atomically: a file is written completely or not at all.

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace penumbra {

// Writes the bytes to an unused name in the folder of `path` and then renames the file to `path`. A symbolic
// link keeps its target, and a replaced file keeps its permissions. A file without write permission is not
// replaced. Devices and pipes are written in place. On failure, throws InputError, "PATH: error: cannot
// write: why; ...", and leaves no file behind.
void WriteWholeFile(const std::string& path, std::string_view bytes);

struct FileToWrite {
  std::string path;
  std::string_view bytes;
};
// Writes several files that belong together: writes all of them under temporary names before it replaces the
// first one. Each file is written as by WriteWholeFile().
void WriteWholeFiles(std::span<const FileToWrite> files);

// Throws the error of WriteWholeFile() if WriteWholeFile() cannot write to the path. Writes nothing.
void CheckCanWrite(const std::string& path);

// True if the path names a device or a pipe. WriteWholeFile() writes devices and pipes in place, not by way
// of a renamed temporary file.
bool IsDevice(const std::string& path);

// The target of a chain of symbolic links, whether or not this target exists.
std::filesystem::path ResolveSymlinks(std::filesystem::path path);

// Throws an InputError: the path cannot be written for the reason `why`.
[[noreturn]] void FailToWrite(const std::string& path, const std::string& why);

}  // namespace penumbra
