// solver/base/whole_file.h
//
// Writes files atomically: a file is written completely or not at all.

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace penumbra {

// Writes the bytes to a new file of unused name in the folder of `path`, and then renames the new file to
// `path`. If `path` is a symbolic link, the target of the link is replaced; the new file gets the permissions
// of the old file. A file without write permission is not replaced. Devices and pipes are written directly,
// without a temporary file. On failure, throws InputError with the message "PATH: error: cannot write: why;
// ...", and leaves no file behind.
void WriteWholeFile(const std::string& path, std::string_view bytes);

struct FileToWrite {
  std::string path;
  std::string_view bytes;
};
// Writes several files that belong together: all files are written under temporary names before the first
// existing file is replaced. WriteWholeFiles() writes each file in the same way as WriteWholeFile().
void WriteWholeFiles(std::span<const FileToWrite> files);

// Throws the InputError that WriteWholeFile() would throw if it cannot write to the path. CheckCanWrite()
// writes nothing.
void CheckCanWrite(const std::string& path);

// True if the path names a device or a pipe. WriteWholeFile() writes to devices and pipes directly, without a
// temporary file.
bool IsDevice(const std::string& path);

// The path at the end of a chain of symbolic links, whether or not a file exists there.
std::filesystem::path ResolveSymlinks(std::filesystem::path path);

// Throws InputError with the message that the path cannot be written for the reason `why`.
[[noreturn]] void FailToWrite(const std::string& path, const std::string& why);

}  // namespace penumbra
