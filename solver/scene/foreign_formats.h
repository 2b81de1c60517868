// solver/scene/foreign_formats.h
//
// The file formats that are read by the library Assimp: how the formats are recognised, and which unit of
// length and up axis they use.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/assimp_import.h"
#include "solver/scene/foreign_scene.h"
#include "solver/scene/scene_frame.h"

namespace penumbra {

struct ForeignFormatEntry {
  std::string name;  // the name of the file format, such as "glTF"
  // The endings of the format's files without the dot; the first one tells Assimp the format.
  std::vector<std::string> endings;
  // The value of ForeignFormat::name for files of the format; empty if the first bytes of a file do not show
  // the format.
  std::string description;
  AssimpImport import;     // the settings of Assimp for the format, without AssimpImport::ending
  UpAxis up = UpAxis::kZ;  // the axis that points up in files of the format, by definition or by custom
};

const std::vector<ForeignFormatEntry>& ForeignFormats();

// The format of a file that begins with the given bytes, whatever its name; null if the bytes show none of
// the formats of ForeignFormats().
const ForeignFormatEntry* FormatByContent(std::string_view beginning);
// The format of files with the given ending, without the dot; null if no format has this ending.
const ForeignFormatEntry* FormatByEnding(std::string_view ending);

// The unit of length and the up axis of a file, and whether the file or its format defines them.
struct ForeignFrame {
  SceneFrame frame;
  bool unit_said = false, up_said = false;
};

// The unit of length and the up axis of a COLLADA file, given by its first elements `unit` and `up_axis`. If
// a COLLADA file lacks the elements `unit` and `up_axis`, the COLLADA standard defines metres and y up.
ForeignFrame ColladaFrame(std::string_view bytes);

// The unit of length and the up axis of a file of the given format. `read` is the scene that Assimp has read
// from the file.
ForeignFrame FrameOf(const ForeignFormatEntry& format, std::string_view bytes, const ForeignScene& read);

}  // namespace penumbra
