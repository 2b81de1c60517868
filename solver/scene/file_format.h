// solver/scene/file_format.h
//
// Recognises the format of a file by its first bytes, for the error message if a scene file or another text
// was expected.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace penumbra {

enum class FormatKind {
  kScene,     // a scene in a format that this program does not read, which the user can export as OBJ
  kPacked,    // an archive or a compressed file
  kEncoding,  // text in an encoding such as UTF-16
  kSolution,  // a solution file, written by `penumbra solve -o`
  kHdf5,      // an HDF5 file that another program has written
  kOther      // any other file, such as a picture, a document or a program
};

struct ForeignFormat {
  FormatKind kind = FormatKind::kOther;
  std::string_view name;  // the name of the file format with its article, such as "a Blender file"
};

// The number of bytes at the beginning of a file that FindForeignFormat() needs.
inline constexpr std::size_t kFormatBytes = 512;

// Returns the format of a file that begins with the bytes `beginning`; nullopt if the format is unknown or is
// line-based text such as OBJ, MTL and CSV.
std::optional<ForeignFormat> FindForeignFormat(std::string_view beginning);

// The error message for a file of the format `format`, if a file of the kind `wanted` was expected, such as
// "an OBJ file". For a Blender file, for example, the message is "this is a Blender file; export OBJ, and
// give that".
std::string ForeignFormatMessage(const ForeignFormat& format, std::string_view wanted);

}  // namespace penumbra
