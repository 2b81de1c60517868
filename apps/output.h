// apps/output.h
//
// Where results go.

#pragma once

#include <optional>
#include <string>

namespace penumbra {

// Throws InputError unless a file can be written at `path`: before the work, so that hours are not lost to a
// misspelt folder. Touches nothing.
void CheckWritable(const std::string& path);

// Writes the text to the file, beside its place and then renamed; without a path to standard output. Throws
// InputError, and leaves nothing behind, if that fails.
void WriteResult(const std::optional<std::string>& path, const std::string& text);

}  // namespace penumbra
