// solver/scene/file_format.h
//
// What a file is that somebody took for a scene, told by its first bytes.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace penumbra {

enum class FormatKind {
  kScene,     // of another format: it can be exported
  kPacked,    // an archive, or compressed
  kEncoding,  // a text whose characters are not single bytes
  kSolution,  // what `penumbra solve -o` wrote
  kHdf5,      // of others
  kOther      // pictures, documents, programs
};

struct ForeignFormat {
  FormatKind kind = FormatKind::kOther;
  std::string_view name;  // "a Blender file"
};

// As many bytes as the longest of the beginnings needs.
inline constexpr std::size_t kFormatBytes = 512;

// The format that the bytes at a file's beginning show, if it is known and none of line-based text as OBJ,
// MTL and CSV are.
std::optional<ForeignFormat> FindForeignFormat(std::string_view beginning);

// "this is a Blender file; export OBJ, and give that": for a file that should have been `wanted` ("an OBJ
// file").
std::string ForeignFormatMessage(const ForeignFormat& format, std::string_view wanted);

}  // namespace penumbra
