// solver/base/whole_file.h
//
// Files that are there as a whole or not at all.

#pragma once

#include <string>
#include <string_view>

namespace penumbra {

// Writes the bytes to the file, beside its place under a name that nobody has, and then renamed; a link goes
// on pointing where it does. Devices and pipes are written to as they stand. Throws InputError, "PATH: error:
// cannot write: why; ...", and leaves nothing behind, if that fails.
void WriteWholeFile(const std::string& path, std::string_view bytes);

// Whether something stands there that is written to as it is.
bool IsDevice(const std::string& path);

// The error of a place that cannot be written to, to be thrown.
[[noreturn]] void FailToWrite(const std::string& path, const std::string& why);

}  // namespace penumbra
