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
// replaced. Devices and pipes are written to directly. On failure, throws InputError, "PATH: error: cannot
// write: why; ...", and leaves no file behind.
void WriteWholeFile(const std::string& path, std::string_view bytes);

struct FileToWrite {
  std::string path;
  std::string_view bytes;
};
// Writes several files that belong together: replaces none before all are written under their temporary
// names. Otherwise as WriteWholeFile().
void WriteWholeFiles(std::span<const FileToWrite> files);

// Checks that WriteWholeFile() can write to the path, and throws the same error if it cannot. Writes nothing.
void CheckCanWrite(const std::string& path);

// True if the path names a device or a pipe. These are written in place, not by way of a renamed temporary
// file.
bool IsDevice(const std::string& path);

// The target of a chain of symbolic links, whether or not this target exists.
std::filesystem::path ResolveSymlinks(std::filesystem::path path);

// Throws the InputError for a path that cannot be written.
[[noreturn]] void FailToWrite(const std::string& path, const std::string& why);

}  // namespace penumbra
