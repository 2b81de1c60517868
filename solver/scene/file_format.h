// solver/scene/file_format.h
//
// Recognises files of other formats by their first bytes, when a scene or another text was expected.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace penumbra {

enum class FormatKind {
  kScene,     // a scene in another format; the user can export it as OBJ
  kPacked,    // an archive, or compressed
  kEncoding,  // text in an encoding such as UTF-16
  kSolution,  // written by `penumbra solve -o`
  kHdf5,      // HDF5 files of other programs
  kOther      // pictures, documents, programs
};

struct ForeignFormat {
  FormatKind kind = FormatKind::kOther;
  std::string_view name;  // "a Blender file"
};

// The number of bytes that FindForeignFormat() needs.
inline constexpr std::size_t kFormatBytes = 512;

// The format of a file that begins with these bytes; nullopt if the format is unknown or is line-based text
// such as OBJ, MTL and CSV.
std::optional<ForeignFormat> FindForeignFormat(std::string_view beginning);

// The message for a file that should have been `wanted` ("an OBJ file"), for example "this is a Blender file;
// export OBJ, and give that".
std::string ForeignFormatMessage(const ForeignFormat& format, std::string_view wanted);

}  // namespace penumbra
